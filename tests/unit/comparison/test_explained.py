"""Which changes explain an effect."""

from functools import reduce

from framegen.comparison.changes import changes
from framegen.comparison.effect import Effect
from framegen.comparison.explained import explain

from tests.in_turn import in_turn
from tests.mutations.edits import SERVO, pair_of
from tests.mutations.places import with_

MOVE = ("messages", "ServoMove")


def explained(effect: Effect, *edits: tuple[object, ...]) -> list[str]:
    """Return the rules of what explains an effect on the servos, which are edited so."""
    new = reduce(lambda data, edit: with_(data, *edit), edits, SERVO)
    return [each.rule for each in explain(effect, changes(pair_of(SERVO, new)))]


WIDER = (*MOVE, "fields", "time_ms", "type", "u32")
WORDS = (*MOVE, "summary", "Move.")
HEADER = ("frame", "header", "bytes", "55 AA")
METHOD = (*MOVE, "method", "move(targets, time_ms)")
ELSEWHERE = ("messages", "ServoUnload", "id", 99)


@in_turn(
    "edits, axis, path, expected",
    lambda: [
        ([WIDER, WORDS, ELSEWHERE], "wire", MOVE, ["field-type"]),
        ([HEADER, WORDS, ELSEWHERE], "wire", MOVE, ["part-bytes"]),
        ([HEADER, METHOD], "wire", MOVE, ["part-bytes"]),
        ([HEADER, METHOD], "programs", MOVE, ["method-changed"]),
        ([WIDER, METHOD], "programs", (*MOVE, "fields", "time_ms"), ["field-type"]),
        ([WORDS], "wire", MOVE, ["words"]),
        ([("protocol", "name", "servos")], "programs", ("protocol", "name"), ["library-renamed"]),
    ],
)
def test_the_nearest_changes_explain(
    edits: list[tuple[object, ...]], axis: str, path: tuple[str, ...], expected: list[str]
) -> None:
    effect = Effect(axis, "refused", path, path, "It differs.")  # type: ignore[arg-type]
    assert explained(effect, *edits) == expected


def test_what_an_effect_names_explains_it_too() -> None:
    path = ("messages", "BatteryVoltageRead")
    effect = Effect("conversation", "no reply", path, path, "BatteryVoltage is refused.")
    longer = ("messages", "BatteryVoltage", "fields", "voltage_mv", "type", "u32")
    assert explained(effect, longer, ELSEWHERE) == ["field-type"]
