"""The walk through a stream that the pages show: step by step, and true to the reference."""

from framegen.cases.invalid import spoilt
from framegen.model.model import derive
from framegen.targets.docs.drawing import interruption
from framegen.targets.docs.stream_examples import stream_examples
from framegen.targets.docs.walkthrough import Walkthrough, walkthrough

from tests.factories import DEMO, compiled_file, compiled_of, data_of, layout_of
from tests.mutations.places import GONE, having
from tests.unit.site.peers import Event
from tests.unit.site.reference import reference

BUSSERVO = reference("busservo").model


def events_of(shown: Walkthrough) -> list[Event]:
    return [
        ["message", event.data.hex(), event.message]
        if event.message
        else ["noise", event.data.hex(), event.reason]
        for event in shown.events
    ]


def test_the_reference_shows_every_way_to_refuse_that_noise_meets() -> None:
    reasons = {
        event.reason
        for example in stream_examples(BUSSERVO)
        for event in example.walkthrough.events
        if event.reason
    }
    assert reasons == {"unknown command", "count mismatch", "too short"}


def test_a_stray_byte_costs_one_byte() -> None:
    shown = walkthrough(BUSSERVO, BUSSERVO.directions[0], bytes.fromhex("55 55 55 02 07"))
    assert events_of(shown) == [
        ["noise", "55", "unknown command"],
        ["message", "55550207", "ActionGroupStop"],
    ]
    assert [(step.offset, step.bytes, step.ok) for step in shown.steps] == [
        (0, "55 55", True),
        (2, "55", True),
        (3, "02", False),
        (0, "55", False),
        (1, "55 55", True),
        (3, "02", True),
        (4, "07", True),
        (1, "", True),
    ]
    assert shown.steps[-1].text == "ActionGroupStop, whole: 4 bytes from here"


def test_where_every_id_is_a_message_no_example_has_an_unknown_one() -> None:
    data = data_of(DEMO)
    plain = data["messages"]["StationRead"]
    sent = [each for each in data["messages"].values() if each["direction"] == plain["direction"]]
    for code in set(range(256)) - {each["id"] for each in sent}:
        name = f"Code{chr(65 + code // 26)}{chr(97 + code % 26)}"
        data["messages"][name] = {**plain, "id": code, "examples": []}
    spec = compiled_of(data).read
    assert spec is not None
    layout = derive(spec)
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
    assert [arrow.message for arrow in shown.arrows] == [
        "StationRead",
        "VentJammed",
        "StationState",
    ]
    # Without that report, nothing that the station sends is one.
    without = {"messages.VentJammed": GONE, "messages.VentsOpen.reports": GONE}
    spec = compiled_of(having(data, without)).read
    assert spec is not None
    assert interruption(derive(spec)) is None


def test_an_empty_list_in_an_example_removes_no_stream_example() -> None:
    example = "messages.VentsOpen.examples.0"
    empty = {
        "messages.VentsOpen.fields.vents.count": "0..8",
        f"{example}.hex": "C3 5A A5 10 00 03 00 00 00",
        f"{example}.values": {"ramp_s": 0, "vents": []},
    }
    spec = compiled_of(having(data_of(DEMO), empty)).read
    assert spec is not None
    examples = stream_examples(derive(spec))
    assert [each.id for each in examples] == [
        each.id for each in stream_examples(compiled_file(DEMO).model)
    ]
    assert examples[0].walkthrough.data.hex() == "c35aa5100003000000"


def test_a_report_of_another_end_comes_between_no_request_and_its_reply() -> None:
    data = having(data_of(DEMO), {"messages.VentJammed.direction": "display -> gateway"})
    spec = compiled_of(data).read
    assert spec is not None
    assert interruption(derive(spec)) is None
