"""Writing of output: only what is framegen's own, and never half of a file."""

from __future__ import annotations

from framegen.writing.change import Change
from framegen.writing.create import create
from framegen.writing.replace import replace
from framegen.writing.survey import Survey, changes, survey
from framegen.writing.write import Written, write

__all__ = ["Change", "Survey", "Written", "changes", "create", "replace", "survey", "write"]
