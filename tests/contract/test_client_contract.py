"""What a client does with each request, typed in by hand: the spec and the library say the same."""

from __future__ import annotations

from typing import TypeAlias

from busservo import AsyncController, Controller
from busservo._exchanges import EXCHANGES
from framegen.model.exchanges import STEPS_PER_SECOND

from tests.factories import BUSSERVO, compiled_file
from tests.in_turn import in_turn

# Method, arguments in order, reply, what is returned of it, reports that follow, what is echoed.
Row: TypeAlias = (
    "tuple[str, tuple[str, ...], str | None, str, tuple[str, ...], tuple[tuple[str, str], ...]]"
)
STARTED, COMPLETED, POSITIONS = "ActionGroupStarted", "ActionGroupCompleted", "ServoPositions"
ECHO = (("servo_ids", "positions.servo_id"),)
# The report that says that it was taken; how long it lasts, and how many steps of it make a second.
RESULTS: dict[str, tuple[str | None, tuple[str, int] | None]] = {
    "ServoMove": (None, ("time_ms", 1000)),
    "ActionGroupRun": (STARTED, None),
}
CONTRACT: dict[str, Row] = {
    "ServoMove": ("move_servos", ("targets", "time_ms"), None, "", (), ()),
    "ActionGroupRun": ("run_action_group", ("group", "times"), None, "", (STARTED, COMPLETED), ()),
    "ActionGroupStop": ("stop_action_group", (), None, "", ("ActionGroupStopped",), ()),
    "ActionGroupSpeed": ("set_action_group_speed", ("group", "percent"), None, "", (), ()),
    "BatteryVoltageRead": ("read_battery_voltage", (), "BatteryVoltage", "voltage_mv", (), ()),
    "ServoUnload": ("unload_servos", ("servo_ids",), None, "", (), ()),
    "ServoPositionsRead": (
        "read_servo_positions",
        ("servo_ids",),
        POSITIONS,
        "positions",
        (),
        ECHO,
    ),
}


@in_turn("client", lambda: [Controller, AsyncController])
@in_turn("name", lambda: CONTRACT)
def test_a_method_raises_for_its_values_if_it_is_given_any(client: type, name: str) -> None:
    method, arguments, *_ = CONTRACT[name]
    said = " ".join(str(getattr(client, method).__doc__).split())
    assert ("EncodeError for values" in said) is bool(arguments)
    assert "TransportError." in said


def test_the_spec_says_what_the_table_says() -> None:
    exchanges = compiled_file(BUSSERVO).model.exchanges
    assert {
        each.request.name: (
            each.method.name,
            tuple(each.method.arguments),
            None if each.reply is None else each.reply.name,
            each.method.result,
            each.reports,
            each.echoed,
        )
        for each in exchanges
    } == CONTRACT
    lasting = {
        each.request.name: (each.lasts.name, STEPS_PER_SECOND[each.lasts.field.unit])
        for each in exchanges
        if each.lasts is not None
    }
    assert {
        each.request.name: (each.acknowledged, lasting.get(each.request.name))
        for each in exchanges
        if each.acknowledged is not None or each.lasts is not None
    } == RESULTS


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
    exchanges = compiled_file(BUSSERVO).model.exchanges
    rooms = {each.request.name: each.most for each in exchanges if each.most}
    assert rooms["ServoPositionsRead"] == 84
