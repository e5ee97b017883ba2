"""The examples of the rules of change, built into a small spec: both editions, as data."""

import copy
from functools import cache
from typing import Any

from framegen.comparison.changes.change import ChangeRule
from framegen.language.spec import Spec
from framegen.model.model import derive

from tests.bad_specs import BASES
from tests.factories import Data, data_in, data_of

# What an example leaves out, as it does not matter to it.
_MESSAGE = {"direction": "host -> lamp", "summary": "A message.", "cite": "manual", "length": 0}
_FIELD = {"about": "A field."}


@cache
def example(rule: ChangeRule) -> tuple[Data, Data]:
    """Return the spec before and after, without examples of frames but for the rule's own."""
    before, after = (data_in(text) if text else {} for text in (rule.before, rule.after))
    return _built(rule, before, after), _built(rule, after, before)


def _built(rule: ChangeRule, own: Data, other: Data) -> Data:
    spec = data_of(BASES / "lamps.yaml")
    for message in spec["messages"].values():
        del message["examples"]
    # Longer than any request with the same id, so that no example tells of frames that fit both.
    spec["messages"]["LampState"]["fields"]["level"]["type"] = "u64"
    spec["sources"]["board"] = {"title": "A board", "kind": "observation"}
    if rule.subject == "program" and "pose" in {*own, *other}:
        _with_pose(spec)
    around = spec
    for step in rule.at.split(".") if rule.at else ():
        around = around.setdefault(step, {})
    _merge(around, own, other)
    if "frames" in own:
        del spec["frame"]
        for message in spec["messages"].values():
            message.setdefault("frame", next(iter(own["frames"])))
    _completed(spec)
    return spec


def _merge(around: Data, own: Data, other: Data) -> None:
    for key in other:
        if key not in own and key != "messages":
            around.pop(key, None)
    if len(own) > 1 and [*own] == [*other][::-1]:
        # What comes in another order takes the place of all.
        for key in own:
            around.pop(key, None)
    for key, value in own.items():
        if key == "messages":
            for name, message in copy.deepcopy(value).items():
                around["messages"][name] = {**around["messages"].get(name, {}), **message}
        else:
            around[key] = copy.deepcopy(value)


def _completed(spec: Data) -> None:
    """Add what the example leaves out, and the lengths that follow from the fields."""
    ids = [name for name, part in spec.get("frame", {}).items() if part["is"] == "id"]
    for message in spec["messages"].values():
        if len(ids) > 1 and isinstance(message["id"], int):
            message["id"] = {**dict.fromkeys(ids, 0), ids[0]: message["id"]}
        for key, value in _MESSAGE.items():
            message.setdefault(key, value)
        for field in message.get("fields", {}).values():
            _complete(field)
    model = derive(Spec.model_validate(spec))
    for name, layout in model.messages.items():
        message = spec["messages"][name]
        if not layout.optional:
            message["length"] = str(layout.formula)
        elif not isinstance(message["length"], list):
            message["length"] = [*layout.possible]


def _complete(field: Data) -> None:
    field.setdefault("about", _FIELD["about"])
    for value in field.get("values", {}).values():
        value.setdefault("about", "A value.")
    for inner in field.get("fields", {}).values():
        _complete(inner)


def _with_pose(spec: Data) -> None:
    """Give the lamps what a pose needs: messages that read, move and let go of several."""
    ids = {
        "count": {"type": "u8"},
        "lamp_ids": {"type": "u8", "counted_by": "count", "count": "1.."},
    }
    level: Any = {"lamp_id": {"type": "u8"}, "level": {"type": "u16"}}
    levels = {
        "count": {"type": "u8"},
        "levels": {"element": "Level", "counted_by": "count", "count": "1..", "fields": level},
    }
    fades = {**levels, "levels": {**levels["levels"], "element": "Fade"}}
    spec["messages"] |= {
        "LampsRead": {
            "id": 20,
            "reply": "Levels",
            "echoed": {"lamp_ids": "levels.lamp_id"},
            "fields": ids,
        },
        "Levels": {"id": 20, "direction": "lamp -> host", "fields": levels},
        "LampsFade": {"id": 21, "fields": {"time_ms": {"type": "u16", "unit": "ms"}, **fades}},
        "LampsOff": {"id": 22, "fields": ids},
    }
    spec["messages"] = copy.deepcopy(spec["messages"])
