"""The table of targets. A new one is a folder, and a row here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.targets import docs, python, schema, vectors

if TYPE_CHECKING:
    from framegen.targets.target import Target

TARGETS: tuple[Target, ...] = (python.TARGET, docs.TARGET, vectors.TARGET, schema.TARGET)
