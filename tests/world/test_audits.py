"""Audits by any spec, of any bytes: nothing is lost, and every report can be written."""

import json
from random import Random

from framegen.audit.audit import audit
from framegen.audit.plain import as_json
from framegen.audit.recording import read_recording
from framegen.audit.sighting import Reader
from framegen.audit.text import as_markdown, as_text
from framegen.model.codec import encode
from framegen.model.stream import ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.contract.test_random_specs import model_of
from tests.factories import Data, compiled_of
from tests.lines.tallied_line import audited, spoken
from tests.random_specs import lines, specs, values_of, with_examples


@given(specs(), st.data())
def test_nothing_is_lost_and_messages_are_the_reference_s(spec: Data, data: st.DataObject) -> None:
    model = model_of(spec)
    named = data.draw(st.lists(st.sampled_from([*model.messages]), min_size=1, max_size=4))
    frames = [encode(model.messages[name], data.draw(values_of(spec, name))) for name in named]
    line = data.draw(lines(frames))
    recording = read_recording("line", line, [*model.spec.endpoints], model.roles, "raw")
    seen = [*Reader(model, model.directions).read(recording)]
    assert b"".join(each.data for each in seen) == line
    expected = [
        (event.at, event.message.name)
        for event in ReferenceDecoder(model, model.directions).decode(line)
        if event.message is not None
    ]
    assert expected == [
        (each.at, each.message.name)
        for each in seen
        if each.message is not None and not each.undocumented
    ]
    found = audit(model, [recording] if line else [], model.directions)
    assert json.loads(json.dumps(as_json(found), allow_nan=False))["bytes"] == len(line)
    assert [*as_text(found)]
    assert [*as_markdown(found)]


@given(specs(), st.integers(0, 1 << 32))
def test_a_recording_covers_what_was_said(spec: Data, seed: int) -> None:
    compiled = compiled_of(with_examples(spec))
    if compiled.findings:
        return
    tally = spoken(compiled.model, Random(seed), 20)  # noqa: S311 - the same each time
    found = audited(compiled.model, tally.text)
    assert found.misfits == []
    seen = {name: each.seen for name, each in found.coverage.messages.items()}
    unsure = sum(tally.messages.values()) - sum(seen.values())
    assert unsure == found.unsure
    assert all(tally.messages[name] >= each for name, each in seen.items())
