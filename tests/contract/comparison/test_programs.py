"""What breaks in programs: told from the two libraries, and seen in a program that uses them."""

import re

import pytest
from framegen.comparison.comparison import Comparison
from framegen.comparison.effect import Effect
from framegen.comparison.pair import Pair
from framegen.comparison.programs import program_effects
from framegen.comparison.programs.folding import folded
from framegen.comparison.programs.types import gives, takes
from framegen.comparison.report import FORMATS
from framegen.comparison.report.view import View
from framegen.comparison.surface import Argument, Entry, Surface, read_surface

from tests.contract.comparison.program_verdicts import Verdict, names_about, verdict_on
from tests.in_turn import in_turn
from tests.mutations.edits import ALL, EDITS, SPECS, edition, pair_of
from tests.mutations.mutations import after
from tests.mutations.places import with_

# ------------------------------------------------------------------ surfaces

FILES = {
    "__init__.pyi": "from .messages import Move as Move\nfrom .messages import LIMIT as LIMIT\n",
    "messages.py": '''
LIMIT: typing.Final = 0x10

class _Base(Sent):
    pass

class Move(_Base):
    """Words."""
    __match_args__ = ("time_ms", "targets")
    COMMAND = 3
    LENGTHS = range(8, 255, 3)
    FRAME = ASK
    time_ms = SwappedU16(5, unit="ms")
    far = Optional(F32(7))
    targets = Items(7, Target, 1, 83, count=servo_count)
    name = Text(4, 8)

    def __new__(cls, time_ms: int, targets: Iterable[int] = (), *, sequence: int = 0) -> Self:
        return cls.made(time_ms)

    @property
    def far_away(self) -> bool:
        """Words."""
        return self.far > 1

    async def wait(self, *names: str) -> None:
        pass

    def _hidden(self) -> None:
        pass
''',
    "device.py": "def made() -> Move:\n    pass\n",
    "strategies.py": "",
}


def test_a_surface_has_all_that_a_program_can_name() -> None:
    made = (
        Argument("time_ms", "by place", "int", None),
        Argument("targets", "by place", "Iterable[int]", "()"),
        Argument("sequence", "by name", "int", "0"),
    )
    assert read_surface(FILES).entries == {
        "Move": Entry(
            "class", arguments=made, bases=("_Base", "Sent"), positions=("time_ms", "targets")
        ),
        "Move.COMMAND": Entry("constant", value="3"),
        "Move.time_ms": Entry("attribute", "int"),
        "Move.far": Entry("attribute", "float | None"),
        "Move.targets": Entry("attribute", "tuple[Target, ...]"),
        "Move.name": Entry("attribute", "str"),
        "Move.far_away": Entry("property", "bool", "self.far > 1"),
        "Move.wait": Entry("function", "None", arguments=(Argument("names", "many", "str", ""),)),
        "LIMIT": Entry("constant", value="16"),
        "device.made": Entry("function", "Move", arguments=()),
    }


@in_turn(
    "old, new, fits",
    lambda: [
        ("int", "int", True),
        ("int", "float", True),
        ("float", "int", False),
        ("int", "int | None", True),
        ("int | None", "int", False),
        ("Iterable[tuple[int, int]]", "Iterable[tuple[int, float]]", True),
        ("Iterable[tuple[int, int]]", "Iterable[tuple[int, int, int]]", False),
        ("Literal['a', 'b']", "Literal['b', 'c', 'a']", True),
        ("Literal['a', 'b']", "Literal['b']", False),
    ],
)
def test_an_argument_takes_what_it_took(old: str, new: str, fits: bool) -> None:
    assert takes(old, new) is fits


@in_turn(
    "old, new, fits",
    lambda: [
        ("Sent", "Run", True),
        ("Run", "Sent", False),
        ("int | None", "int", True),
        ("int", "int | None", False),
        ("float", "int", False),
    ],
)
def test_a_result_is_what_it_was(old: str, new: str, fits: bool) -> None:
    library = Surface({"Sent": Entry("class"), "Run": Entry("class", bases=("Sent",))})
    assert gives(old, new, library) is fits


# ------------------------------------------------------------------ what is told


# Of an edit, what programs written before it notice, and what those notice that were written after
# it, when they are given what was before.
# What is other values only is turned round by `_turned`: {0} is the old one in front.
def _turned(text: str, old: str, new: str) -> tuple[list[str], list[str]]:
    return [text.format(old, new)], [text.format(new, old)]


NOTHING: tuple[list[str], list[str]] = ([], [])
CASES: dict[str, tuple[list[str], list[str]]] = {
    "words about a field": NOTHING,
    "bytes of an example": NOTHING,
    "byte order of all": NOTHING,
    "bytes of the header": NOTHING,
    "version": NOTHING,
    "baud": _turned(
        "+ value: `open_controller(baud={1})` is the default; it was {0}", "9600", "19200"
    ),
    "name of the library": _turned(
        "renamed: `import {0}` is now `import {1}`", "busservo", "servobus"
    ),
    "name of the client": (
        [
            (
                "renamed: `Controller` is now `Climate`, `open_async_controller` is now "
                "`open_async_climate`, `open_controller` is now `open_climate`"
            )
        ],
        [
            (
                "renamed: `Climate` is now `Controller`, `open_async_climate` is now "
                "`open_async_controller`, `open_climate` is now `open_controller`"
            )
        ],
    ),
    "no HID board": (["removed: `hid://` does not find 0483:5750 any more"], []),
    "id": _turned("value: `ServoMove.COMMAND` is {1}; it was {0}", "3", "4"),
    "unit": _turned("meaning: `ServoMove`: time_ms = 1 {0} means 1 {1}", "ms", "s"),
    "name of a message": (
        ["renamed: `StationState` is now `Measured`, `strategies.station_state` is now `measured`"],
        ["renamed: `Measured` is now `StationState`, `strategies.measured` is now `station_state`"],
    ),
    "name of the last field": _turned("renamed: `VentJammed.{0}` is now `{1}`", "trim", "offset"),
    "name of an element": _turned("renamed: `{0}` is now `{1}`", "Vent", "Flap"),
    "field removed": (
        ["removed: `VentJammed.trim` is gone"],
        [
            "arguments: `VentJammed()`: `trim` has to be given as well",
            "+ added: `VentJammed.trim` is new",
        ],
    ),
    "order of fields": _turned(
        "order: `VentJammed()`: takes ({1}) now; it took ({0})", "vent_id, trim", "trim, vent_id"
    ),
    "type of the last field": (
        [],
        ["refused: `VentJammed(trim=-32768)` is refused: trim: -32768 is outside -128..127"],
    ),
    "count narrowed": (
        ["refused: `VentsOpen(vents=[8 of them])` is refused: vents: 8 items is outside 1..7"],
        [],
    ),
    "message added": (
        ["+ added: `Beep` and `Controller.beep` are new"],
        ["removed: `Beep`, `Controller.beep` and `Device.on_beep` are gone"],
    ),
    "name and arguments of a method": (
        [
            "renamed: `Controller.vents_open` is now `open`",
            "order: `Controller.open()`: takes (ramp_s, vents) now; it took (vents, ramp_s)",
        ],
        [
            "renamed: `Controller.open` is now `vents_open`",
            "order: `Controller.vents_open()`: takes (vents, ramp_s) now; it took (ramp_s, vents)",
        ],
    ),
    "not acknowledged": (
        ["result: `Controller.run_action_group` returns Sent; it returned Run"],
        ["+ added: `run_action_group()` tells whether it `started`, by ActionGroupStarted"],
    ),
    "field not optional any more": (
        ["arguments: `Tail()`: `second` has to be given"],
        ["type: `Tail.second` is int | None; it was int"],
    ),
    "number of a named value": (
        ["value: `VentsOpen.RAMP_S_AT_ONCE` is 1; it was 0, so ramp_s = 1 means at_once"],
        ["value: `VentsOpen.RAMP_S_AT_ONCE` is 0; it was 1, so ramp_s = at_once means 1"],
    ),
    "place of a bit": _turned(
        "value: `Flags.ERROR_HEAT` is {1}; it was {0}, so error.heat = 1 means 0", "2", "4"
    ),
    "bits removed": (
        ["removed: `Flags.ERROR_CODE` and `Flags.error_code` are gone"],
        ["+ added: `Flags.error_code` is new"],
    ),
    "range of addresses": (
        [
            (
                "refused: `Numbers(station=500)` and `Lists(station=500)` are refused: "
                "station: 500 is outside 1..400"
            )
        ],
        [],
    ),
    "limits narrowed": (
        [
            (
                "refused: `move_servos()` raises LimitError outside 100..900 by default; "
                "it took 0..1000 for `targets.position`"
            )
        ],
        [],
    ),
    "not signed any more": (
        ["removed: `ServoPosition.signed_position` is gone"],
        ["+ added: `ServoPosition.signed_position` is new"],
    ),
}


def told(pair: Pair) -> list[str]:
    """Return each effect as a line, with a + in front of what breaks nothing."""
    return [f"{'' if e.breaks else '+ '}{e.outcome}: {e.text}" for e in program_effects(pair)]


@pytest.mark.parametrize("name", CASES)
def test_programs_are_told_what_becomes_of_the_names_that_they_use(name: str) -> None:
    old, new = EDITS[name]
    if old is ALL and old["messages"] != new["messages"]:
        # The messages that are as they were take most of the time.
        before, after_ = old["messages"], new["messages"]
        other = [each for each in before if before[each] != after_[each]]
        old, new = (
            with_(data, "messages", {each: data["messages"][each] for each in other})
            for data in (old, new)
        )
    pair = pair_of(old, new)
    assert (told(pair), told(pair.turned)) == CASES[name]


def test_a_field_is_renamed_alike_whether_the_spec_says_so_or_not() -> None:
    for said in ("said", "unsaid"):
        made = after("weather", [f"a field renamed, {said}"])
        assert made is not None
        assert [line.split(":")[0] for line in told(Pair(made.old, made.new))] == ["renamed"]


# What no library can be made of, with what is wrong with it.
CONTRADICTIONS = {
    "list removed": (
        ("messages", "ServoUnload", "method"),
        "messages.ServoUnload.method: ServoUnload has no argument `servo_ids`",
    ),
    "client and device exchanged": (
        ("messages", "ServoMove", "lasts"),
        (
            "messages.ServoMove.lasts: "
            "ServoMove goes host -> controller, and a client sends controller -> host"
        ),
    ),
    "type in an element": (
        ("messages", "VentsOpen", "fields", "vents", "fields", "angle", "range"),
        "messages.VentsOpen.fields.vents.fields.angle.range: -900 is no i8: it holds -128..127",
    ),
}


@pytest.mark.parametrize("name", CONTRADICTIONS)
def test_names_that_cannot_be_compared_are_uncertain_and_every_report_says_so(name: str) -> None:
    pair = pair_of(*EDITS[name])
    path, why = CONTRADICTIONS[name]
    for each, paths in ((pair, (None, path)), (pair.turned, (path, None))):
        (effect,) = (e for e in program_effects(each) if e.outcome == "not compared")
        assert (effect.old, effect.new, effect.certain) == (*paths, False)
        text = f"names could not be compared: no library can be made of new.yaml, {why}"
        assert effect.text == text
        view = View(Comparison(each.old, each.new))
        for form, render in FORMATS.items():
            shown = render(view).replace("&gt;", ">").replace("\\", "")
            assert "names could not be compared: no library can be made of" in shown, form


def test_what_keeps_a_library_from_being_made_is_no_example() -> None:
    pair = pair_of(*EDITS["bytes of an example"])
    assert pair.new.compiled.tolerated
    assert told(pair) == []


def test_names_of_the_frame_are_told_as_one() -> None:
    made = after("lamp", ["address: added"])
    assert made is not None
    added = "`OneDevice`, `UnknownFrame.address` and `Controller.device`"
    assert f"+ added: {added} are new" in told(Pair(made.old, made.new))
    removed = "`OneDevice`, `Controller.device` and `UnknownFrame.address`"
    assert f"removed: {removed} are gone" in told(Pair(made.new, made.old))


def test_of_many_names_some_are_told() -> None:
    path = ("messages", "Beep")
    texts = [f"`Beep.{letter}` is new" for letter in "abcdef"]
    (effect,) = folded(Effect("programs", "added", None, path, text) for text in texts)
    assert effect.text == "`Beep.a`, `Beep.b`, `Beep.c`, `Beep.d` and 2 more are new"


def test_what_breaks_and_what_is_new_are_two() -> None:
    path = ("messages", "Beep")
    found = [
        Effect("programs", "value", path, path, "`Beep.A` is 1; it was 2"),
        Effect("programs", "value", path, path, "`Beep.B` is 1; it was 2"),
        Effect("programs", "removed", path, None, "`Beep.C` is gone"),
        Effect("programs", "removed", path, path, "`Beep.D` is gone"),
        Effect("programs", "meaning", path, path, "`Beep`: times = 1 ms is read as 1 s"),
    ]
    assert folded(found) == found


def test_paths_lead_into_both_editions() -> None:
    old, new = EDITS["name of a value"]
    (effect,) = program_effects(pair_of(old, new))
    values = ("messages", "VentsOpen", "fields", "ramp_s", "values")
    assert (effect.old, effect.new) == ((*values, "at_once"), (*values, "now"))


# ------------------------------------------------------------------ what is seen

# A few of each kind; tests/world has the others.
SAMPLE = [
    ("weather", "u16 became u8"),
    ("lamp", "a byte added in end"),
    ("lamp", "checksum: added"),
    ("lamp", "messages in another order"),
    ("lamp", "words: summary"),
]


def assert_seen(verdict: Verdict, pair: Pair) -> None:
    """Hold what is told of programs to what becomes of one."""
    if not verdict.breaking:
        # Frames that two messages may be are of a few values alone, of which not all are tried.
        assert [each for each in verdict.differing if not each.endswith(", None)")] == []
    for effect in verdict.seen:
        words = {word for each in verdict.differing for word in re.findall(r"\w+", each)}
        assert words, effect
        if effect.old is not None and effect.old[0] == "messages" and len(effect.old) > 1:
            assert words & names_about(effect, pair), effect


@pytest.mark.parametrize(("spec", "mutation"), SAMPLE)
def test_a_program_sees_what_is_told_and_nothing_else(spec: str, mutation: str) -> None:
    made = after(spec, [mutation])
    assert made is not None
    for one in (made, made.turned):
        verdict = verdict_on(Pair(one.old, one.new))
        assert verdict is not None
        assert_seen(verdict, Pair(one.old, one.new))


def test_nothing_is_told_or_seen_of_an_edition_and_itself() -> None:
    same = edition(SPECS["greenhouse"])
    assert verdict_on(Pair(same, same)) == Verdict([], [])
