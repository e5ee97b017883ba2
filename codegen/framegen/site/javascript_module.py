"""The codec of a protocol as a JavaScript module, with its types."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.model.model import Model


def javascript_module(_model: Model) -> dict[str, str]:
    """Return the files of the module by name: none yet."""
    return {}
