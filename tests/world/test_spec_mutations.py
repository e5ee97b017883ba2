"""A second opinion, by hand: change any one fact of the spec, and `framegen check` reports it.

Facts that `check` cannot see by nature are listed in BLIND, each with its reason, and held to be
unseen: they need another guard.
"""

import json
from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

import pytest
from framegen.checks import remarks

from tests.factories import BUSSERVO, FIRST, Steps, compiled_of, data_of
from tests.mutations.places import GONE, at, differs, dotted, leaves, nodes, other_way, swaps, with_

Mutation: TypeAlias = tuple[Steps, Any]

TREE: Any = data_of(BUSSERVO)
MESSAGES: Any = TREE["messages"]


def mutated(steps: Steps, value: Any) -> Any:
    assert differs(at(TREE, steps), value), "a mutation changes something"
    return with_(TREE, *steps, value)


def rules_broken(tree: Any) -> set[str]:
    """Return the rules of all findings, or those of remarks where there are none."""
    compiled = compiled_of(tree)
    found = compiled.findings or remarks(compiled.model, compiled.tree)
    return {finding.rule for finding in found}


def steps_of(path: str) -> Steps:
    return tuple(int(step) if step.isdecimal() else step for step in path.split("."))


def named(mutation: Mutation) -> str:
    return f"{dotted(mutation[0])}={json.dumps(mutation[1])}"[:90]


# ------------------------------------------------------------------ one fact after the other


def numbers() -> Iterator[tuple[Steps, Any]]:
    """Yield every number field, those inside elements included."""
    for path, value in nodes(MESSAGES, ("messages",)):
        if path[-2:-1] == ("fields",) and "fields" not in value:
            yield path, value


def examples() -> Iterator[tuple[Steps, Any]]:
    for name, message in MESSAGES.items():
        for index, example in enumerate(message["examples"]):
            yield ("messages", name, "examples", index), example
    for name, other in TREE["lookalikes"].items():
        for index, example in enumerate(other.get("examples", [])):
            yield ("lookalikes", name, "examples", index), example


def codes() -> Iterator[Mutation]:
    used = {message["id"] for message in MESSAGES.values()}
    for name, message in MESSAGES.items():
        yield ("messages", name, "id"), message["id"] + 1
        for code in sorted(used - {message["id"]}):
            yield ("messages", name, "id"), code


def directions() -> Iterator[Mutation]:
    for name, message in MESSAGES.items():
        yield ("messages", name, "direction"), other_way(message["direction"])


def length_rules() -> Iterator[Mutation]:
    for name, message in MESSAGES.items():
        steps = ("messages", name, "length")
        rule = str(message["length"])
        factor, _, rest = rule.rpartition("servo_count")
        constant = int(rest.removeprefix(" + "))
        for off in (-1, 1):
            yield steps, rule.removesuffix(str(constant)) + str(constant + off)
        if "servo_count" in rule:
            yield steps, f"{int(factor.removesuffix(' * ') or 1) + 1} * servo_count + {constant}"
            yield steps, f"{rule.replace('servo_count', 'servos')}"
            yield steps, constant


def widths() -> Iterator[Mutation]:
    for steps, field in [*numbers(), *frame_numbers()]:
        for other in ("u8", "u16", "u32"):
            if other != field["type"]:
                yield (*steps, "type"), other
        signed = {"u8": "i8", "u16": "i16"}[field["type"]]
        yield (*steps, "type"), signed


def frame_numbers() -> Iterator[tuple[Steps, Any]]:
    for frame in (("frame",), ("lookalikes", "lx16a", "frame")):
        for name, part in at(TREE, frame).items():
            if "type" in part:
                yield (*frame, name), part


def frame_parts() -> Iterator[Mutation]:
    yield ("byte_order",), "big"
    for steps in (("frame",), ("lookalikes", "lx16a", "frame")):
        for hex_ in ("55 56", "54 55", "55", "55 55 55"):
            yield (*steps, "header", "bytes"), hex_
    for index in range(3):
        yield ("frame", "length", "counts", index), GONE
    yield ("frame", "length", "counts"), ["header", "length", "command", "parameters"]
    yield ("frame",), dict(reversed(TREE["frame"].items()))
    swapped = ["header", "command", "length", "parameters"]
    yield ("frame",), {key: TREE["frame"][key] for key in swapped}
    other = ("lookalikes", "lx16a", "frame")
    for index in range(4):
        yield (*other, "length", "counts", index), GONE
        yield (*other, "checksum", "covers", index), GONE


def field_orders() -> Iterator[Mutation]:
    """Yield each two neighbouring fields, swapped."""
    for path, value in nodes(MESSAGES, ("messages",)):
        if path[-1] == "fields":
            yield from ((path, {name: value[name] for name in order}) for order in swaps(value))


def field_names() -> Iterator[Mutation]:
    for name, message in MESSAGES.items():
        fields = message.get("fields", {})
        for key in fields:
            renamed = {("other" if each == key else each): fields[each] for each in fields}
            yield ("messages", name, "fields"), renamed
            yield ("messages", name, "fields", key), GONE


def ranges() -> Iterator[Mutation]:
    """Yield a range that would refuse what the examples show, or that none of them reaches."""
    for name, message in MESSAGES.items():
        for key, field in message.get("fields", {}).items():
            if key != "servo_count" and "fields" not in field:
                yield ("messages", name, "fields", key), {**field, "range": "3..4"}


def count_bounds() -> Iterator[Mutation]:
    bounds = {
        ("ServoMove", "targets"): ["2..", "3..", "1..1", "1..84", "84.."],
        ("ServoUnload", "servo_ids"): ["4..", "1..5", "1..253", "253.."],
        ("ServoPositionsRead", "servo_ids"): ["7..", "1..5", "1..253", "253.."],
        ("ServoPositions", "positions"): ["2..", "0..5", "0..85", "85.."],
    }
    for (name, key), wrong in bounds.items():
        for bound in wrong:
            yield ("messages", name, "fields", key, "count"), bound


def named_values() -> Iterator[Mutation]:
    for steps, field in numbers():
        for name, value in field.get("values", {}).items():
            for other in (value["value"] - 1, value["value"] + 1):
                yield (*steps, "values", name, "value"), other


def example_bytes() -> Iterator[Mutation]:
    for steps, example in examples():
        data = bytes.fromhex(example["hex"])
        for index in range(len(data)):
            flipped = bytearray(data)
            flipped[index] ^= 0x01
            yield (*steps, "hex"), flipped.hex(" ")
        yield (*steps, "hex"), data[:-1].hex(" ")
        yield (*steps, "hex"), (data + b"\0").hex(" ")


def example_values() -> Iterator[Mutation]:
    for steps, example in examples():
        for where, value in leaves(example.get("values", {}), (*steps, "values")):
            yield where, value + 1
            yield where, GONE


def origins() -> Iterator[Mutation]:
    for steps, example in examples():
        for key in ("cite", "constructed"):
            if key in example:
                yield (*steps, key), GONE
    for name, message in MESSAGES.items():
        yield ("messages", name, "cite"), f"not_{message['cite']}"
        yield ("messages", name, "examples"), []
    for name in TREE["sources"]:
        yield ("sources", name), GONE
    yield ("protocol", "authority"), "nobody"


def answers() -> Iterator[Mutation]:
    """Yield a reply that is no reply; and a query without one is no query, as an erratum has it."""
    for name, message in MESSAGES.items():
        if "reply" in message:
            yield ("messages", name, "reply"), name
            yield ("messages", name, "reply"), "Nothing"
        for index in range(len(message.get("reports", []))):
            yield ("messages", name, "reports", index), name
    yield ("messages", "BatteryVoltageRead", "reply"), GONE


POSITION: Steps = ("messages", "ServoMove", "fields", "targets", "fields", "position")
PLACE: Steps = ("messages", "ServoPositions", "fields", "positions", "fields", "position")


def limits() -> Iterator[Mutation]:
    """Yield limits that no frame can reach, or of a field that no client sends."""
    for wrong in ("1000..0", "0..", "0..65536", "-1..1000"):
        yield (*POSITION, "limits", "usual"), wrong
    for wrong in ("2500..500", "500..", "500..65536"):
        yield (*POSITION, "limits", "others", "PWM servo boards"), wrong
    yield (*POSITION, "limits", "usual"), GONE
    yield PLACE, {"type": "u16", "about": "Where it is.", "limits": {"usual": "0..1000"}}


def signed_and_absent() -> Iterator[Mutation]:
    for wrong in ("i8", "i32", "u16", "int"):
        yield (*PLACE, "signed_as"), wrong
    yield ("messages", "ServoUnload", "fields", "servo_ids", "type"), "i8"
    yield (*PLACE[:-1], "servo_id", "type"), "i8"
    yield (*PLACE, "values", "absent", "absent"), "yes"


def poses() -> Iterator[Mutation]:
    for key in ("read", "move", "release"):
        for name in MESSAGES:
            if name != TREE["pose"][key]:
                yield ("pose", key), name
    for wrong in ("1..", "9..1", "0..256", "-1..9"):
        yield ("pose", "ids"), wrong
    for key in ("hold", "present", "targets"):
        for wrong in ("move_servos", "Hold", "hold-servos"):
            yield ("pose", key), wrong
    yield ("pose", "present"), TREE["pose"]["hold"]
    for key in TREE["pose"]:
        yield ("pose", key), GONE
    yield ("messages", "ServoPositionsRead", "echoed"), GONE


def results() -> Iterator[Mutation]:
    """Yield results of a command: of a message that comes, and in a unit of time."""
    yield ("messages", "ActionGroupRun", "acknowledged"), "ActionGroupStopped"
    yield ("messages", "ActionGroupRun", "acknowledged"), "Nothing"
    yield ("messages", "ActionGroupRun", "reports", 0), GONE
    for other in ("servo_count", "targets", "position", "group"):
        yield ("messages", "ServoMove", "lasts"), other
    for unit in ("", "mm", "min"):
        yield ("messages", "ServoMove", "fields", "time_ms", "unit"), unit


def errata() -> Iterator[Mutation]:
    for index, erratum in enumerate(TREE["errata"]):
        yield ("errata", index, "document"), erratum["bytes"]
        yield ("errata", index, "bytes"), "something else"
        yield ("errata", index, "bytes"), GONE
        for key in erratum["concerns"]:
            wrong = 99 if key in ("parameter", "example") else "Nothing"
            yield ("errata", index, "concerns", key), wrong
    for index, unknown in enumerate(TREE["unknowns"]):
        for key in unknown["concerns"]:
            yield ("unknowns", index, "concerns", key), "Nothing"


def rest() -> Iterator[Mutation]:
    for name in ("host", "controller"):
        yield ("endpoints", name), GONE
    yield ("protocol", "version"), "99.0.0"
    yield ("history", 0, "version"), "99.0.0"
    for index, reserved in enumerate(TREE["reserved"]):
        if any(message["id"] == reserved["id"] for message in MESSAGES.values()):
            yield ("reserved", index, "direction"), other_way(reserved["direction"])
        yield ("reserved", index, "id"), 3
    for name in MESSAGES:
        yield ("messages", name), GONE


KINDS: list[Callable[[], Iterator[Mutation]]] = [
    *(codes, directions, length_rules, widths, frame_parts, field_orders, field_names, ranges),
    *(count_bounds, named_values, example_bytes, example_values, origins, answers, limits),
    *(signed_and_absent, poses, results, errata, rest),
]


# ------------------------------------------------------------------ what `check` cannot see

SHOWN_TOO = "the examples show that number as well, and do not say what it means"
SWALLOWED = "examples of look-alikes say no values, and what the code leaves is parameters"
NOT_MISSED = "nothing else speaks of it; `framegen diff` shows what was removed"
SAME_BYTES = "no frame at hand distinguishes the two; the contract tests of the library must"
SMALL_NUMBERS = "no frame at hand has the highest bit set; the contract tests must try it"
OUTSIDE = "no frame carries it"


# What is changed, to what, and why nobody sees it.
BLIND: list[tuple[str, Any, str]] = [
    ("messages.ActionGroupRun.fields.times.values.unlimited.value", 1, SHOWN_TOO),
    ("messages.ActionGroupStarted.fields.times.values.unlimited.value", 1, SHOWN_TOO),
    ("lookalikes.lx16a.frame.command.type", "u16", SWALLOWED),
    ("lookalikes.lx16a.frame.command.type", "u32", SWALLOWED),
    ("messages.ActionGroupStop", GONE, NOT_MISSED),
    ("messages.ActionGroupRun.reports.1", GONE, NOT_MISSED),
    ("messages.ActionGroupStop.reports.0", GONE, NOT_MISSED),
    ("messages.ActionGroupRun.acknowledged", GONE, NOT_MISSED),
    ("messages.ActionGroupRun.acknowledged", "ActionGroupCompleted", SAME_BYTES),
    ("messages.ServoMove.lasts", GONE, NOT_MISSED),
    ("reserved.0", GONE, NOT_MISSED),
    ("errata.0", GONE, NOT_MISSED),
    ("errata.0.document", 7, "the document is not at hand: only that it differs is held"),
    ("messages.ServoMove.fields.targets.count", "0..", SAME_BYTES),
    ("messages.ServoMove.fields.targets.count", "1..82", SAME_BYTES),
    ("messages.ServoUnload.fields.servo_ids.count", "0..", SAME_BYTES),
    ("messages.ServoUnload.fields.servo_ids.count", "2..", SAME_BYTES),
    ("messages.ServoUnload.fields.servo_ids.count", "1..251", SAME_BYTES),
    ("messages.ServoPositionsRead.fields.servo_ids.count", "0..", SAME_BYTES),
    ("messages.ServoPositionsRead.fields.servo_ids.count", "2..", SAME_BYTES),
    ("messages.ServoPositionsRead.fields.servo_ids.count", "1..251", SAME_BYTES),
    ("messages.ServoPositions.fields.positions.count", "1..", SAME_BYTES),
    ("messages.ServoPositions.fields.positions.count", "0..83", SAME_BYTES),
    ("messages.ServoMove.fields.targets.fields.servo_id.type", "i8", SMALL_NUMBERS),
    ("messages.ServoMove.fields.targets.fields.position.type", "i16", SMALL_NUMBERS),
    ("messages.ActionGroupRun.fields.group.type", "i8", SMALL_NUMBERS),
    ("messages.ActionGroupRun.fields.times.type", "i16", SMALL_NUMBERS),
    ("messages.ActionGroupSpeed.fields.percent.type", "i16", SMALL_NUMBERS),
    ("messages.ServoUnload.fields.servo_ids.type", "i8", SMALL_NUMBERS),
    ("messages.ActionGroupStarted.fields.group.type", "i8", SMALL_NUMBERS),
    ("messages.ActionGroupStarted.fields.times.type", "i16", SMALL_NUMBERS),
    ("messages.ActionGroupCompleted.fields.group.type", "i8", SMALL_NUMBERS),
    ("messages.ActionGroupCompleted.fields.times.type", "i16", SMALL_NUMBERS),
    ("messages.BatteryVoltage.fields.voltage_mv.type", "i16", SMALL_NUMBERS),
    ("messages.ServoMove.fields.targets.fields.position.limits.usual", "0..900", OUTSIDE),
    (
        "messages.ServoMove.fields.targets.fields.position.limits.usual",
        "0..799",
        "the other boards take what the examples send",
    ),
    ("messages.ServoMove.fields.targets.fields.position.limits", GONE, NOT_MISSED),
    ("messages.ServoPositions.fields.positions.fields.position.signed_as", GONE, NOT_MISSED),
    (
        "messages.ServoPositions.fields.positions.fields.position.values.absent.absent",
        GONE,
        NOT_MISSED,
    ),
    ("pose", GONE, NOT_MISSED),
    ("pose.ids", "1..20", OUTSIDE),
    ("link.baud", 115200, OUTSIDE),
    ("link.parity", "even", OUTSIDE),
    ("messages.BatteryVoltage.fields.voltage_mv.scale", "0.01 V", OUTSIDE),
    ("messages.ServoMove.fields.time_ms.unit", "s", OUTSIDE),
]
HIDDEN = [(steps_of(path), value, why) for path, value, why in BLIND]
UNSEEN = {json.dumps([steps, value]) for steps, value, _ in HIDDEN}

# What says that a message goes from the host to the controller.
FACING = {"method", "reply", "reports", "acknowledged", "lasts", "echoed"}


def is_out_of_sight(steps: Steps, value: Any) -> bool:
    """Return whether no rule can see a change, for a reason that holds for each message alike.

    Of the messages with which the spec began, BLIND lists them one by one.
    A message that nothing else names may be gone. One that in addition says nothing of a client
    may go the other way. A number may have a sign where no example has its highest bit set, and a
    name may stand for another number that the examples show.
    """
    if steps[0] != "messages" or steps[1] in FIRST:
        return False
    message = MESSAGES[steps[1]]
    if len(steps) == 2 or steps[2] == "direction":
        named = any(text == steps[1] for path, text in leaves(TREE) if path[:2] != steps[:2])
        return not named and (len(steps) == 2 or not FACING & message.keys())
    shown = shown_of(message["examples"], steps[3::2])
    if steps[-1] == "type" and value in HIGHEST_BITS:
        return 0 <= max(shown, default=-1) < HIGHEST_BITS[value]
    return steps[-3:-2] == ("values",) and value in shown


HIGHEST_BITS = {"i8": 0x80, "i16": 0x8000}


def shown_of(examples_of_one: list[Any], names: Steps) -> set[int]:
    """Return the values of a field in examples; `names` lead to it, and may lead further."""
    shown = set()
    for path, value in leaves([each["values"] for each in examples_of_one]):
        to_value = tuple(step for step in path if isinstance(step, str))
        if to_value == names[: len(to_value)]:
            shown.add(value)
    return shown


@pytest.mark.parametrize(
    "mutation",
    [
        pytest.param(mutation, id=f"{kind.__name__}: {named(mutation)}")
        for kind in KINDS
        for mutation in kind()
        if json.dumps(mutation) not in UNSEEN and not is_out_of_sight(*mutation)
    ],
)
def test_a_changed_fact_of_the_spec_is_reported(mutation: Mutation) -> None:
    assert rules_broken(mutated(*mutation)) != set()


@pytest.mark.parametrize(
    ("steps", "value", "why"),
    [pytest.param(*each, id=named(each[:2])) for each in HIDDEN],
)
def test_the_changes_that_check_cannot_see_are_listed(steps: Steps, value: Any, why: str) -> None:
    """Once this fails, `check` sees more than it did: move the line to the facts that are seen."""
    assert rules_broken(mutated(steps, value)) == set(), why
