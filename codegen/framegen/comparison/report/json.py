"""The report for programs: one line of JSON a comparison.

Its keys stay; `shape` rises if the meaning of one changes. Paths are dotted, and null where an
edition has no such thing; places are `file:line:column`.

    shape      1
    protocol   the name in the new edition
    old, new   of each edition: `edition`, where it is from; `version`; `findings`, by today's rules
               (`new` and the findings are null where the spec is gone)
    upgrade    which end is upgraded first; "" where nothing breaks between them
    version    `due`: "major", "minor", "patch" or null; `finding`: what is wrong with it, or null
    verdicts   of each axis and each two ends: `axis`, `ends` (null for programs), and `counts` of
               effects by standing (breaks, uncertain, accepted, adds) and outcome
    effects    `axis`, `standing`, `outcome`, `text`, `ends`, `old`, `new`, `accepted` (the reason,
               or ""), `because` (indices of changes), `editions` (the kept ones that show it, where
               the old one does not), `remedy` (or ""), and `witness`, a frame or null: `sender`
               (old or new), `message`, `hex`, `values`, `outcome`, `reading`
    changes    `rule`, `text`, `old`, `new`, `old_place`, `new_place`, `has_effect`
    tried      of each message of each edition: `sender`, `message`, `direction`, `counts` of frames
               by outcome, `all`: false where there would have been more to try out
    idle       what the history accepts, and nothing breaks: `version`, `path`, `reason`
"""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

from framegen.comparison.explained import explain
from framegen.comparison.report.verdict import standing
from framegen.reading.yamltree import dotted

if TYPE_CHECKING:
    from framegen.comparison.changes.change import Change
    from framegen.comparison.edition import Edition
    from framegen.comparison.effect import Effect, Witness
    from framegen.comparison.report.view import View
    from framegen.reading.yamltree import KeyPath

SHAPE = 1


def render(view: View) -> str:
    """Return one line of JSON."""
    return json.dumps(data_of(view), allow_nan=False) + "\n"


def data_of(view: View) -> dict[str, Any]:
    """Return the report as plain data."""
    return {
        "shape": SHAPE,
        "protocol": view.new.spec.protocol.name,
        "old": _edition(view.old),
        "new": _edition(view.new),
        "upgrade": view.order,
        "version": {"due": view.bump, "finding": view.version_finding},
        "verdicts": [
            {
                "axis": each.axis,
                "ends": None if each.ends is None else str(each.ends),
                "counts": {name: dict(counted) for name, counted in each.counts.items()},
            }
            for each in view.verdicts
        ],
        "effects": [_effect(view, each) for each in view.effects],
        "changes": [_change(view, each) for each in view.comparison.changes],
        "tried": [
            {
                "sender": each.sender,
                "message": each.message.name,
                "direction": str(each.way),
                "counts": each.counts,
                "all": each.all_tried,
            }
            for each in view.comparison.trials
        ],
        "idle": [
            {"version": each.version, "path": each.path, "reason": each.reason}
            for each in view.idle
        ],
    }


def _edition(edition: Edition) -> dict[str, Any]:
    return {
        "edition": edition.label,
        "version": edition.version,
        "findings": len(edition.compiled.tolerated),
    }


def _effect(view: View, effect: Effect) -> dict[str, Any]:
    changes = view.comparison.changes
    return {
        "axis": effect.axis,
        "standing": standing(effect),
        "outcome": effect.outcome,
        "text": effect.text,
        "ends": effect.ends,
        "old": _path(effect.old),
        "new": _path(effect.new),
        "accepted": effect.accepted,
        "editions": [*effect.editions],
        "remedy": effect.remedy,
        "because": [changes.index(each) for each in explain(effect, changes)],
        "witness": None if effect.witness is None else _witness(effect.witness),
    }


def _witness(witness: Witness) -> dict[str, Any]:
    return {
        "sender": witness.sender,
        "message": witness.message,
        "hex": witness.data.hex(" ").upper(),
        "values": _plain(witness.values),
        "outcome": witness.outcome,
        "reading": witness.reading,
    }


def _change(view: View, change: Change) -> dict[str, Any]:
    return {
        "rule": change.rule,
        "text": change.text,
        "old": _path(change.old),
        "new": _path(change.new),
        "old_place": None if change.old is None else view.old.place(change.old),
        "new_place": None if change.new is None else view.new.place(change.new),
        "has_effect": change in view.explaining,
    }


def _path(path: KeyPath | None) -> str | None:
    return None if path is None else dotted(path)


def _plain(value: Any) -> Any:
    """Return a value as JSON has it, which knows no infinity: `"inf"`."""
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if hasattr(value, "items"):
        return {str(name): _plain(each) for name, each in value.items()}
    return value
