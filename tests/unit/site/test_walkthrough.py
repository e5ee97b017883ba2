"""The walk through a stream that the pages show: step by step, and true to the reference."""

from framegen.cases.invalid import spoilt
from framegen.model.model import Model, derive
from framegen.targets.docs.drawing import interruption
from framegen.targets.docs.stream_examples import stream_examples
from framegen.targets.docs.walkthrough import walkthrough

from tests.factories import DEMO, Data, compiled_file, compiled_of, data_of, layout_of
from tests.mutations.places import GONE, having
from tests.unit.site.reference import reference

BUSSERVO = reference("busservo").model


def derived(data: Data) -> Model:
    """Return the model of a spec, whatever rules it breaks."""
    spec = compiled_of(data).read
    assert spec is not None
    return derive(spec)


def test_the_reference_shows_every_way_to_refuse_that_noise_meets() -> None:
    events = [event for each in stream_examples(BUSSERVO) for event in each.walkthrough.events]
    reasons = {event.reason for event in events if event.reason}
    assert reasons == {"unknown command", "count mismatch", "too short"}


def test_a_stray_byte_costs_one_byte() -> None:
    shown = walkthrough(BUSSERVO, BUSSERVO.directions[0], bytes.fromhex("55 55 55 02 07"))
    events = [(each.data.hex(), each.message or each.reason) for each in shown.events]
    assert events == [("55", "unknown command"), ("55550207", "ActionGroupStop")]
    assert [(step.offset, step.bytes, step.ok) for step in shown.steps] == [
        *((0, "55 55", True), (2, "55", True), (3, "02", False), (0, "55", False)),
        *((1, "55 55", True), (3, "02", True), (4, "07", True), (1, "", True)),
    ]
    assert shown.steps[-1].text == "ActionGroupStop, whole: 4 bytes from here"


def test_where_every_id_is_a_message_no_example_has_an_unknown_one() -> None:
    data = data_of(DEMO)
    plain = data["messages"]["StationRead"]
    sent = [each for each in data["messages"].values() if each["direction"] == plain["direction"]]
    for code in set(range(256)) - {each["id"] for each in sent}:
        name = f"Code{chr(65 + code // 26)}{chr(97 + code % 26)}"
        data["messages"][name] = {**plain, "id": code, "examples": []}
    layout = derived(data)
    assert "unknown" not in [example.id for example in stream_examples(layout)]
    message = layout.messages["StationRead"]
    frame = message.message.examples[0].hex
    titles = [said for said, _ in spoilt(layout, message, frame)]
    assert "a byte too many" in titles
    assert "an unknown command" not in titles


def test_a_report_comes_between_a_request_and_its_reply_only_from_the_same_end() -> None:
    data = data_of(DEMO)
    shown = interruption(layout_of(data))
    assert shown is not None
    messages = ["StationRead", "VentJammed", "StationState"]
    assert [arrow.message for arrow in shown.arrows] == messages
    # Without that report, nothing that the station sends is one; nor is it one of another end.
    without = {"messages.VentJammed": GONE, "messages.VentsOpen.reports": GONE}
    for change in (without, {"messages.VentJammed.direction": "display -> gateway"}):
        assert interruption(derived(having(data, change))) is None


def test_an_empty_list_in_an_example_removes_no_stream_example() -> None:
    example = "messages.VentsOpen.examples.0"
    empty = {
        "messages.VentsOpen.fields.vents.count": "0..8",
        f"{example}.hex": "C3 5A A5 10 00 03 00 00 00",
        f"{example}.values": {"ramp_s": 0, "vents": []},
    }
    examples = stream_examples(derived(having(data_of(DEMO), empty)))
    full = stream_examples(compiled_file(DEMO).model)
    assert [each.id for each in examples] == [each.id for each in full]
    assert examples[0].walkthrough.data.hex() == "c35aa5100003000000"
