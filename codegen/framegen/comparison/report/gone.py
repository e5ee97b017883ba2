"""The report on a spec that is gone, in each format: everything of its protocol breaks."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from framegen.comparison.report.github import workflow_message, workflow_property
from framegen.comparison.report.json import SHAPE
from framegen.comparison.report.verdict import BREAKS
from framegen.targets.docs.escape import code, markdown

if TYPE_CHECKING:
    from collections.abc import Callable

    from framegen.comparison.editions import Gone

# Nobody sends its frames or reads them, and there is no library.
_AXES = ("wire", "programs")


def exit_status(fail_on: frozenset[str]) -> int:
    """Return the exit status of a spec that is gone."""
    return 0 if fail_on.isdisjoint(_AXES) else BREAKS


def _text(gone: Gone) -> str:
    said = f"{gone.protocol}: {gone.edition} ({gone.version}) -> nothing\n\n  {gone}\n"
    if gone.released:
        said += f"    do: Where it is meant, remove {gone.edition} and those before it, too.\n"
    return said


def _json(gone: Gone) -> str:
    effects: list[dict[str, Any]] = [
        {
            "axis": axis,
            "standing": "breaks",
            "outcome": "gone",
            "text": str(gone),
            "ends": "",
            "old": "",
            "new": None,
            "accepted": "",
            "editions": [],
            "remedy": "",
            "because": [],
            "witness": None,
        }
        for axis in _AXES
    ]
    counts = {"breaks": {"gone": 1}}
    report = {
        "shape": SHAPE,
        "protocol": gone.protocol,
        "old": {"edition": gone.edition, "version": gone.version, "findings": None},
        "new": None,
        "upgrade": "",
        "version": {"due": None, "finding": None},
        "verdicts": [{"axis": axis, "ends": None, "counts": counts} for axis in _AXES],
        "effects": effects,
        "changes": [],
        "tried": [],
        "idle": [],
    }
    return json.dumps(report) + "\n"


def _markdown(gone: Gone) -> str:
    return (
        f"## {markdown(gone.protocol)}\n\nCompared with {markdown(gone.version)}: "
        f"{code(gone.edition)} → nothing\n\n**{markdown(str(gone))}**.\n"
    )


def _github(gone: Gone) -> str:
    where = f"file={workflow_property(gone.path)},title={workflow_property(gone.protocol)}"
    return f"::error {where}::{workflow_message(str(gone))}\n{_markdown(gone)}"


FORMATS: dict[str, Callable[[Gone], str]] = {
    "text": _text,
    "json": _json,
    "markdown": _markdown,
    "github": _github,
}
