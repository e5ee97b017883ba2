"""Puts output on disk: what is framegen's own, and only that; nothing half-written, ever."""

from __future__ import annotations

from framegen.writing.change import Change
from framegen.writing.survey import Survey, changes, survey
from framegen.writing.write import Written, write

__all__ = ["Change", "Survey", "Written", "changes", "survey", "write"]
