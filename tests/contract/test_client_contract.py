"""What a client does with each request, typed in by hand; and every fact behind it is tested.

Each key of the spec that faces a client (`method`, `echoed`, `reply`, `reports`, `acknowledged`,
`lasts`) is changed in each way that there is. Then `framegen check` must speak up, or this table.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, TypeAlias

from busservo import AsyncController, Controller
from busservo._exchanges import EXCHANGES
from framegen.model.exchanges import STEPS_PER_SECOND
from pydantic import ValidationError

from tests.factories import BUSSERVO, Data, compiled_values, data_of, layout_of
from tests.in_turn import in_turn

if TYPE_CHECKING:
    from collections.abc import Iterator

# Method, arguments in order, reply, what is returned of it, reports that follow, what is echoed.
Row: TypeAlias = (
    "tuple[str, tuple[str, ...], str | None, str, tuple[str, ...], tuple[tuple[str, str], ...]]"
)
STARTED, COMPLETED = "ActionGroupStarted", "ActionGroupCompleted"
ECHO = (("servo_ids", "positions.servo_id"),)
# The report that says that it was taken; how long it lasts, and how many steps of it make a second.
RESULTS: dict[str, tuple[str | None, tuple[str, int] | None]] = {
    "ServoMove": (None, ("time_ms", 1000)),
    "ActionGroupRun": (STARTED, None),
}
CONTRACT: dict[str, Row] = {
    "ServoMove": ("move_servos", ("targets", "time_ms"), None, "", (), ()),
    "ActionGroupRun": (
        "run_action_group",
        ("group", "times"),
        None,
        "",
        (STARTED, COMPLETED),
        (),
    ),
    "ActionGroupStop": ("stop_action_group", (), None, "", ("ActionGroupStopped",), ()),
    "ActionGroupSpeed": ("set_action_group_speed", ("group", "percent"), None, "", (), ()),
    "BatteryVoltageRead": (
        "read_battery_voltage",
        (),
        "BatteryVoltage",
        "voltage_mv",
        (),
        (),
    ),
    "ServoUnload": ("unload_servos", ("servo_ids",), None, "", (), ()),
    "ServoPositionsRead": (
        "read_servo_positions",
        ("servo_ids",),
        "ServoPositions",
        "positions",
        (),
        ECHO,
    ),
}
TREE = data_of(BUSSERVO)
# All but what is said of the documents: that a fact contradicts them is not enough.
FACTS = {key: TREE[key] for key in TREE if key not in ("errata", "unknowns", "lookalikes")}


def facts_of(data: Data) -> tuple[dict[str, Row], dict[str, Any]] | None:
    """Return what a spec says of its requests, and of the results of its commands.

    None if `framegen check` objects to it.
    """
    try:
        compiled = compiled_values(data)
    except ValidationError:
        return None
    if compiled.findings or compiled.spec is None:
        return None
    exchanges = compiled.model.exchanges
    said: dict[str, Row] = {
        each.request.name: (
            each.method.name,
            tuple(each.method.arguments),
            None if each.reply is None else each.reply.name,
            each.method.result,
            each.reports,
            each.echoed,
        )
        for each in exchanges
    }
    lasting = {
        each.request.name: (each.lasts.name, STEPS_PER_SECOND[each.lasts.field.unit])
        for each in exchanges
        if each.lasts is not None
    }
    results = {
        each.request.name: (each.acknowledged, lasting.get(each.request.name))
        for each in exchanges
        if each.acknowledged is not None or each.lasts is not None
    }
    return said, results


@in_turn("client", lambda: [Controller, AsyncController])
@in_turn("name", lambda: CONTRACT)
def test_a_method_raises_for_its_values_if_it_is_given_any(client: type, name: str) -> None:
    method, arguments, *_ = CONTRACT[name]
    said = " ".join(str(getattr(client, method).__doc__).split())
    assert ("EncodeError for values" in said) is bool(arguments)
    assert "TransportError." in said


def test_the_spec_says_what_the_table_says() -> None:
    assert facts_of(TREE) == (CONTRACT, RESULTS)


def test_the_library_does_what_the_table_says() -> None:
    assert {
        kind.__name__: (
            each.method,
            each.arguments,
            None if each.reply is None else each.reply.__name__,
            each.result,
            tuple(report.__name__ for report in each.reports),
            each.echoed,
        )
        for kind, each in EXCHANGES.items()
    } == CONTRACT
    assert {
        kind.__name__: (each.acknowledged and each.acknowledged.__name__, each.lasts)
        for kind, each in EXCHANGES.items()
        if each.acknowledged is not None or each.lasts is not None
    } == RESULTS


def test_the_number_of_servos_in_a_reply_is_bounded() -> None:
    rooms = {each.request.name: each.most for each in layout_of(TREE).exchanges if each.most}
    assert rooms == {"ServoPositionsRead": 84}


# -------------------------------------------------------------------- each fact, changed


def methods() -> Iterator[tuple[str, str, Any]]:
    for name in [each for each in TREE["messages"] if each in CONTRACT]:
        method, arguments, _, result, *_rest = CONTRACT[name]
        returns = f" -> {result}" if result else ""

        def said(
            method: str = method, given: tuple[str, ...] = arguments, returns: str = returns
        ) -> str:
            return f"{method}({', '.join(given)}){returns}"

        if "method" in TREE["messages"][name]:
            yield name, "method", None
        yield name, "method", said(method=f"{method}_now")
        yield name, "method", said(method="close")
        others = [row[0] for other, row in CONTRACT.items() if other != name]
        yield name, "method", said(method=others[0])
        yield name, "method", said(returns=" -> nothing")
        yield name, "method", said(given=(*arguments, "force"))
        if result:
            yield name, "method", said(returns="")
        if arguments:
            yield name, "method", said(given=arguments[1:])
            yield name, "method", said(given=(*arguments, arguments[0]))
        if len(arguments) > 1:
            yield name, "method", said(given=arguments[::-1])


def echoes() -> Iterator[tuple[str, str, Any]]:
    name = "ServoPositionsRead"
    yield name, "echoed", None
    yield name, "echoed", {}
    yield name, "echoed", {"servo_ids": "positions.position"}
    yield name, "echoed", {"servo_ids": "positions"}
    yield name, "echoed", {"servo_ids": "servo_count"}
    yield name, "echoed", {"servo_count": "positions.servo_id"}
    yield name, "echoed", {"group": "positions.servo_id"}
    for other in CONTRACT:
        if other != name:
            yield other, "echoed", {"servo_ids": "positions.servo_id"}


def answers() -> Iterator[tuple[str, str, Any]]:
    replies = [name for name in TREE["messages"] if name not in CONTRACT]
    for name, (_, _, reply, _, reports, _) in CONTRACT.items():
        for other in replies:
            if other != reply:
                yield name, "reply", other
        if reply is not None:
            yield name, "reply", None
        for at in range(len(reports)):
            yield name, "reports", [*reports[:at], *reports[at + 1 :]]
        for other in replies:
            if other not in reports:
                yield name, "reports", [*reports, other]


def results() -> Iterator[tuple[str, str, Any]]:
    for name in CONTRACT:
        acknowledged, lasts = RESULTS.get(name, (None, None))
        for report in (STARTED, COMPLETED, "ActionGroupStopped", None):
            if report != acknowledged:
                yield name, "acknowledged", report
        fields = [*TREE["messages"][name].get("fields", {}), "nothing", None]
        for field in fields:
            if field != (lasts and lasts[0]):
                yield name, "lasts", field


CHANGES = [*methods(), *echoes(), *answers(), *results()]


@in_turn("name, key, value", lambda: CHANGES)
def test_a_changed_fact_contradicts_the_contract(name: str, key: str, value: Any) -> None:
    data = json.loads(json.dumps(FACTS))
    message = data["messages"][name]
    assert message.get(key) != value, "a mutation changes something"
    if value is None:
        del message[key]
    else:
        message[key] = value
    assert facts_of(data) != (CONTRACT, RESULTS)
