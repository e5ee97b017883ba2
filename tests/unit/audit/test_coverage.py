"""The coverage is what was said, by a tally that was made while it was said."""

from random import Random
from typing import Any

from framegen.audit.audit import Audit
from framegen.audit.values import Values
from framegen.model.slots import Items

from tests.factories import BUSSERVO, compiled_file
from tests.in_turn import in_turn
from tests.lines.tallied_line import Tally, audited, spoken
from tests.protocols.specs import FILES

SPECS = {**FILES, "busservo": BUSSERVO}


def seen_in(found: Audit) -> dict[str, Values]:
    """Return the values seen, by message and path."""
    return {
        f"{name}.{path}": values
        for name, covered in found.coverage.messages.items()
        for path, values in covered.values.items()
        if values.seen
    }


def lists_in(tally: Tally, found: Audit) -> dict[str, list[Any]]:
    """Return the tally by the paths of the audit: of a list of any size, its number of elements."""
    said: dict[str, list[Any]] = {}
    for name, covered in found.coverage.messages.items():
        for slot in covered.layout.arguments:
            path = f"{name}.{slot.name}"
            if isinstance(slot, Items) and slot.text is not None:
                texts = tally.values.get(path, [])
                said[path] = [len(text) for text in texts]
            elif isinstance(slot, Items):
                if not slot.is_fixed:
                    said[path] = tally.values.get(f"len {path}", [])
                said |= {
                    each: values
                    for each, values in tally.values.items()
                    if each.startswith((f"{path}[]", f"{path}."))
                }
            else:
                # Packed numbers have the path of the field.
                said[path] = tally.values.get(f"{path}[]") or tally.values.get(path, [])
    return {path: values for path, values in said.items() if values}


@in_turn("name", lambda: SPECS)
def test_the_coverage_is_what_was_said(name: str) -> None:
    model = compiled_file(SPECS[name]).model
    tally = spoken(model, Random(3))  # noqa: S311 - the same each time
    found = audited(model, tally.text)
    assert found.misfits == []
    assert found.fits
    assert found.unsure == 0
    seen = {each.name: each.seen for each in found.coverage.messages.values() if each.seen}
    assert seen == dict(tally.messages)
    assert found.size == tally.size
    values, said = seen_in(found), lists_in(tally, found)
    assert values.keys() == said.keys()
    for path, each in said.items():
        assert values[path].seen == len(each), path
        assert (values[path].lowest, values[path].highest) == (min(each), max(each)), path
        kept = len(values[path].counts)
        assert kept == len(set(each)), path


def test_values_at_the_edges_of_what_is_documented_are_told() -> None:
    model = compiled_file(BUSSERVO).model
    found = audited(model, "55 55 05 15 01 FF FF\n55 55 07 0B FF 00 00")
    assert not found.fits
    found = audited(model, "55 55 05 0B FF 00 00")
    values = found.coverage.messages["ActionGroupSpeed"].values
    assert values["group"].named_seen == ["all"]
    assert (values["group"].has_low, values["group"].has_high) == (False, True)
    assert (values["percent"].has_low, values["percent"].has_high) == (True, False)


def test_an_example_that_was_seen_as_it_stands_is_none_that_is_missing() -> None:
    model = compiled_file(BUSSERVO).model
    message = model.messages["ServoMove"]
    first, *others = message.message.examples
    found = audited(model, bytes(first.hex).hex())
    unseen = found.coverage.messages["ServoMove"].unseen_examples
    assert [each.title for each in unseen] == [each.title for each in others]


def test_a_frame_of_either_end_covers_neither_until_the_sender_is_known() -> None:
    model = compiled_file(BUSSERVO).model
    stop = "55 55 02 07"
    found = audited(model, stop)
    assert found.unsure == found.seen == 1
    covered = found.coverage.messages
    assert covered["ActionGroupStop"].unsure == covered["ActionGroupStopped"].unsure == 1
    assert covered["ActionGroupStop"].seen == covered["ActionGroupStopped"].seen == 0
    found = audited(model, f"{stop}  # 0.5 s, controller: stopped")
    assert found.unsure == 0
    assert found.coverage.messages["ActionGroupStopped"].seen == 1
