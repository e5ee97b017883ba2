"""How long requests and their replies take on the line, at sizes that belong together."""

from __future__ import annotations

from framegen.targets.docs.timing import round_trips

from tests.factories import BUSSERVO, compiled_file
from tests.protocols.specs import model_of


def test_a_reply_that_lists_what_was_asked_for_has_as_many_elements() -> None:
    model = compiled_file(BUSSERVO).model
    request, reply = model.messages["ServoPositionsRead"], model.messages["ServoPositions"]
    found = [trip for trip in round_trips(model) if trip.request == request.name]
    sizes = {trip.what: trip.size for trip in found}
    for count in (1, 6):
        both = request.size_at(count) + reply.size_at(count)
        assert sizes[f"{count} item{'s' * (count > 1)} in servo_ids"] == both


def test_any_other_reply_is_shown_at_its_smallest_and_at_its_largest() -> None:
    trips = [trip for trip in round_trips(model_of("modbus")) if trip.request == "HoldingRead"]
    assert [(trip.what, trip.size) for trip in trips] == [
        ("1 item in registers", 8 + 7),
        ("125 items in registers", 8 + 255),
    ]
    # What its list says of a request is nothing of a reply that has none.
    writes = [trip for trip in round_trips(model_of("modbus")) if trip.request == "RegistersWrite"]
    assert writes
    assert {trip.reply for trip in writes} == {"RegistersWritten"}
    assert all("," not in trip.what for trip in writes)
