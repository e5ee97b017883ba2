"""What does not fit is found, each kind by itself, and nothing of a recording is lost."""

from random import Random
from typing import Any

import pytest
from framegen.audit.misfits import outside
from framegen.audit.recording import read_recording
from framegen.audit.sighting import Reader, _decoded
from framegen.compile import without_bounds
from framegen.model import stream
from framegen.model.codec import encode
from framegen.model.model import Model
from framegen.model.stream import ReferenceDecoder
from framegen.model.verdict import weigh, weigh_whole
from framegen.reading.yamltree import Unusable
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, compiled_file, compiled_of, data_of
from tests.in_turn import in_turn
from tests.lines.tallied_line import audited, spoken
from tests.protocols.specs import FILES
from tests.strategies import lines

MOVE = "55 55 08 03 01 E8 03 01 20 03"
VOLTAGE = "55 55 04 0F 4C 1D"


def busservo() -> Model:
    return compiled_file(BUSSERVO).model


def narrowed() -> Model:
    """Return busservo with bounds of every kind."""
    data = data_of(BUSSERVO)
    move = data["messages"]["ServoMove"]["fields"]
    move["time_ms"]["range"] = "0..30000"
    move["targets"]["count"] = "1..2"
    position = move["targets"]["fields"]["position"]
    position["range"] = "0..1000"
    del position["limits"]
    return compiled_of(data).model


CASES: list[tuple[str, list[tuple[str, str, int, int]]]] = [
    (f"{MOVE} {VOLTAGE}", []),
    (f"{MOVE} 55 55 03 2A 07 {VOLTAGE}", [("unknown command", "command 42", 1, 5)]),
    (
        f"{MOVE}  # 0 s, host: a\n55 55 03 2A 07  # 1 s, controller noise: unknown command",
        [("unknown command", "command 42 from controller", 1, 5)],
    ),
    (f"00 {MOVE} 00 FF {VOLTAGE}", [("noise", "bad header", 2, 3)]),
    ("55 55 05 0F 4C 1D 00", [("noise", "length mismatch", 1, 7)]),
    (f"{MOVE} 55 55 08 03", [("noise", "too short in ServoMove", 1, 4)]),
]


@in_turn("text, expected", lambda: CASES)
def test_each_kind_of_misfit(text: str, expected: list[tuple[str, str, int, int]]) -> None:
    found = audited(busservo(), text)
    assert [(each.kind, each.what, each.times, each.size) for each in found.misfits] == expected
    assert found.fits is not bool(expected)


# Times and targets of a move, and what of it is outside of what is documented.
UNDOCUMENTED: list[tuple[int, list[tuple[int, int]], list[tuple[str, str]]]] = [
    (30000, [(1, 1000), (2, 0)], []),
    (30001, [(1, 1000)], [("time_ms", "30001, outside 0..30000")]),
    (5, [(1, 1001), (2, 7)], [("targets.position", "1001, outside 0..1000")]),
    (5, [(1, 1), (2, 2), (3, 3)], [("targets", "3 elements, outside 1..2")]),
    (5, [], [("targets", "0 elements, outside 1..2")]),
    (
        40000,
        [(1, 2000)],
        [("targets.position", "2000, outside 0..1000"), ("time_ms", "40000, outside 0..30000")],
    ),
]


@in_turn("time_ms, pairs, expected", lambda: UNDOCUMENTED)
def test_a_value_outside_what_is_documented_is_named(
    time_ms: int, pairs: list[tuple[int, int]], expected: list[tuple[str, str]]
) -> None:
    model = narrowed()
    targets = [{"servo_id": number, "position": at} for number, at in pairs]
    values = {"time_ms": time_ms, "targets": targets}
    frame = encode(without_bounds(model).messages["ServoMove"], values)
    for content in (
        b"\x00" + frame + bytes.fromhex(VOLTAGE),
        f"{frame.hex(' ')}  # 1 s, host: a\n",
    ):
        found = audited(model, content)
        told = [(each.what, each.why) for each in found.misfits if each.kind != "noise"]
        assert told == [(f"ServoMove.{field}", why) for field, why in expected]
        assert {each.kind for each in found.misfits} - {"noise"} == (
            {"undocumented value"} if expected else set()
        )


@in_turn("name", lambda: FILES)
def test_every_frame_that_only_bounds_refuse_is_told_by_its_fields(name: str) -> None:
    model = compiled_file(FILES[name]).model
    free = without_bounds(model)
    tally = spoken(free, Random(9))  # noqa: S311 - the same each time
    recording = read_recording("line", tally.text.encode(), [*model.spec.endpoints], model.roles)
    reader = Reader(model, model.directions)
    for stretch, seen in zip(recording.stretches, reader.read(recording), strict=True):
        ways = [way for way in model.directions if way.sender == stretch.sender]
        assert seen.data == stretch.data
        assert seen.message is not None
        is_allowed = weigh_whole(model, ways, seen.data).message is not None
        assert seen.undocumented is not is_allowed
        if not is_allowed:
            assert [*outside(model.messages[seen.message.name], seen.message, seen.values)]


def test_what_another_edition_refused_is_judged_anew() -> None:
    text = f"{MOVE}  # 0 s, noise: unknown command\n{VOLTAGE}  # 1 s, noise: out of range\n"
    found = audited(busservo(), text)
    # The first came from the controller, which sends no such message.
    assert [each.kind for each in found.misfits] == ["unknown command"]
    assert found.coverage.messages["BatteryVoltage"].seen == 1
    # What was noise for other reasons stays noise.
    (misfit,) = audited(busservo(), f"{VOLTAGE}  # 1 s, noise: too short\n").misfits
    assert (misfit.kind, misfit.what, misfit.size) == ("noise", "too short", 6)


def test_noise_that_was_recorded_in_pieces_is_one_frame() -> None:
    pieces = [b"\x55\x55\x04", b"\x2a\x01", b"\x02\x55\x55\x02\x99"]
    text = "".join(
        f"{piece.hex()}  # 1.{number * 5:02} s, noise: unknown command\n"
        for number, piece in enumerate(pieces)
    )
    first, second = audited(busservo(), text).misfits
    assert (first.kind, first.times, first.size) == ("unknown command", 1, 6)
    assert (second.kind, second.times, second.size) == ("unknown command", 1, 4)
    # Each is where it begins, though the recorder cut them elsewhere.
    assert [each.examples[0][0] for each in (first, second)] == ["line 1", "line 3"]


UNKNOWN = "55 55 02 99"
APART: list[tuple[list[tuple[float, str, str]], list[tuple[str, str, int, str]]]] = [
    # What a monitor of both ends writes: the same bytes raw say the same.
    (
        [
            (1.75, "either noise: bad header", "00 13"),
            (1.75, "either noise: unknown command", UNKNOWN),
            (2.3, "either noise: too short", "55 55 04 0F 4C"),
        ],
        [
            ("unknown command", "command 153", 4, "line 2"),
            ("noise", "too short in BatteryVoltage", 5, "line 3"),
            ("noise", "bad header", 2, "line 1"),
        ],
    ),
    (
        [
            (0.8, "noise: length mismatch", "55 55 02 0F"),
            (1.2, "noise: length mismatch", "00 80 F8 FE 00 80"),
            (1.6, "noise: unknown command", UNKNOWN),
            (2.0, "noise: unknown command", "55 55 08 03 01 E8"),
        ],
        [
            ("unknown command", "command 153 from controller", 4, "line 3"),
            ("noise", "length mismatch", 6, "line 2"),
            ("noise", "unknown command", 6, "line 4"),
            ("noise", "length mismatch in BatteryVoltage", 4, "line 1"),
        ],
    ),
    # The halves of a frame: too late, of another sender, and for another reason.
    (
        [(1.0, "noise: unknown command", "55 55 02"), (1.06, "noise: unknown command", "99")],
        [("noise", "unknown command", 3, "line 1"), ("noise", "unknown command", 1, "line 2")],
    ),
    (
        [(1.0, "noise: unknown command", "55 55 02"), (1.0, "host noise: unknown command", "99")],
        [("noise", "unknown command", 3, "line 1"), ("noise", "unknown command", 1, "line 2")],
    ),
    (
        [(1.0, "noise: too short", "55 55 02"), (1.0, "noise: bad header", "99")],
        [("noise", "too short", 3, "line 1"), ("noise", "bad header", 1, "line 2")],
    ),
]


@in_turn("lines, expected", lambda: APART)
def test_noise_that_a_recorder_judged_apart_stays_apart(
    lines: list[tuple[float, str, str]], expected: list[tuple[str, str, int, str]]
) -> None:
    text = "".join(f"{data}  # {at} s, {who}\n" for at, who, data in lines)
    found = [
        (each.kind, each.what, len(data), place)
        for each in audited(busservo(), text).misfits
        for place, data in each.examples
    ]
    assert sorted(found) == sorted(expected)


def test_halves_of_a_frame_are_joined_unless_the_line_went_quiet() -> None:
    one, other = (f"{half}  # 1 s, noise: unknown command\n" for half in ("55 55 02", "99"))
    for between, unknown in (("", 1), ("# a note\n", 1), ("# quiet\n", 0)):
        kinds = [each.kind for each in audited(busservo(), one + between + other).misfits]
        assert kinds.count("unknown command") == unknown, between


def test_a_recording_with_noise_says_what_its_bytes_say() -> None:
    (lines, _), *_ = APART
    recorded = "".join(f"{data}  # {at} s, {who}\n" for at, who, data in lines)
    raw = " ".join(data for _, _, data in lines)
    one, other = audited(busservo(), recorded), audited(busservo(), raw)
    assert [(each.kind, each.what, each.size) for each in one.misfits] == [
        (each.kind, each.what, each.size) for each in other.misfits
    ]


def test_a_look_alike_is_named() -> None:
    (misfit,) = audited(busservo(), "55 55 02 01").misfits
    assert misfit.why.endswith(
        "it is a frame of the dialect of LeArm and uHand boards, where it asks for the version"
    )


ON_PURPOSE = [
    ("# a query cut short in its fields, and BatteryVoltageRead at once", "too short", True),
    ("# a query cut short in its fields, then BatteryVoltageRead", "too short", True),
    ("# a query cut short in its fields, and BatteryVoltageRead at once", "bad header", False),
    ("# a query cut short in its fields, and BatteryVoltageRead at once", "", False),
    ("# BatteryVoltageRead, example 1", "too short", False),
    ("# a query", "too short", False),
    ("", "too short", False),
    ("", "", False),
]


@in_turn("title, reason, is_meant", lambda: ON_PURPOSE)
def test_what_a_run_of_conform_says_is_malformed_on_purpose_is_no_misfit(
    title: str, reason: str, *, is_meant: bool
) -> None:
    text = f"{title}\n55 55 05  # 1 s, host noise: {reason}\n{VOLTAGE}  # 2 s, controller: a"
    found = audited(busservo(), text)
    assert (found.malformed, found.fits) == (int(is_meant), is_meant)
    assert found.noise == (0 if is_meant else 3)


def test_a_monitor_of_what_the_host_sends_finds_noise_too() -> None:
    text = (
        "# a query cut short in its fields, and BatteryVoltageRead at once\n"
        "# recorded of 'a line' from 2026-01-02 09:08:07 +0000 on\n"
        "00 80 F8 FE 00 80  # 1 s, host noise: bad header\n"
        f"{UNKNOWN}  # 2 s, host noise: unknown command\n"
        "55 55 08 03 01 E8  # 3 s, host noise: too short\n"
    )
    found = audited(busservo(), text)
    assert (found.malformed, found.noise, found.fits) == (0, 12, False)
    assert found.misfits[0].what == "command 153 from host"


def test_noise_is_tolerated_up_to_a_bound_and_an_unknown_command_never() -> None:
    for tolerated, fits in ((0, False), (2, False), (3, True), (100, True)):
        assert audited(busservo(), f"01 02 03 {MOVE}", tolerated).fits is fits
    assert not audited(busservo(), f"55 55 03 2A 07 {MOVE}", 1000).fits


def test_values_beyond_the_limits_are_a_remark() -> None:
    found = audited(busservo(), "55 55 08 03 01 E8 03 01 20 30")
    (values,) = (
        each for each in found.coverage.messages["ServoMove"].values.values() if each.limits
    )
    assert values.beyond_limits == {0x3020: 1}
    assert found.fits


@given(lines | st.binary(max_size=80))
def test_nothing_of_a_recording_is_lost(data: bytes) -> None:
    model = busservo()
    recording = read_recording("line", data, [*model.spec.endpoints], model.roles, "raw")
    found = [*Reader(model, model.directions).read(recording)]
    assert b"".join(each.data for each in found) == data


@given(
    st.binary(max_size=300) | st.text(alphabet="5A0 #\nshost:.noise,", max_size=200).map(str.encode)
)
def test_hostile_content_is_refused_or_read_whole(content: bytes) -> None:
    model = busservo()
    problem, found = "", None
    try:
        found = audited(model, content)
    except Unusable as error:
        problem = str(error)
    assert (found is None) is problem.startswith("line, line ")
    assert found is None or sum(each.size for each in found.misfits) <= found.size


@in_turn("name", lambda: ["busservo", *(each for each in FILES if each != "everything")])
def test_a_long_stretch_is_decoded_in_windows_as_at_once(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    model = compiled_file(FILES.get(name, BUSSERVO)).model
    chance = Random(11)  # noqa: S311 - the same each time
    text = spoken(model, chance, 40).lines
    data = b"".join(bytes.fromhex(line.partition("#")[0]) + chance.randbytes(1) for line in text)
    monkeypatch.setattr("framegen.audit.sighting._WINDOW", 64)
    whole = ReferenceDecoder(model, model.directions).decode(data)
    assert [*_decoded(model, model.directions, data)] == whole


def test_headers_over_and_over_are_not_weighed_again_and_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    weighed = 0

    def counting(*given: Any, **named: Any) -> Any:
        nonlocal weighed
        weighed += 1
        return weigh(*given, **named)

    monkeypatch.setattr(stream, "weigh", counting)
    # As a line at a wrong rate may look: each byte begins a frame, which claims the next 85.
    data = b"\x55" * 1500
    found = audited(busservo(), data)
    assert (found.size, found.seen, found.noise) == (1500, 0, 1500)
    assert weighed < 4 * len(data)
