"""The search of protocols with frames of every kind: it has all there is, and leads to it."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest
from framegen.model.slots import Items
from framegen.site.scripts.codec_scripts import codec_scripts

from tests.protocols.specs import FILES
from tests.unit.site.reference import NODE
from tests.unit.site.scripts import run_script
from tests.unit.site.test_pages_of_protocols import site_of

if TYPE_CHECKING:
    from tests.unit.site.reference import Reference

needs_node = pytest.mark.skipif(NODE is None, reason="node is not installed")


def index_of(site: Reference) -> dict[str, Any]:
    scripts = site.site["search.html"].scripts
    data: dict[str, Any] = json.loads(
        next(text for given, text in scripts if given.get("id") == "search-index")
    )
    return data


@pytest.mark.each_protocol
@pytest.mark.parametrize("name", FILES)
def test_every_entry_leads_to_a_page_and_a_place_on_it(name: str) -> None:
    pages = site_of(name).site
    for entry in index_of(site_of(name))["entries"]:
        page, _, anchor = entry["path"].partition("#")
        assert page in pages, entry
        assert not anchor or anchor in pages[page].ids, entry


@pytest.mark.each_protocol
@pytest.mark.parametrize("name", FILES)
def test_all_that_has_a_name_is_found_by_it(name: str) -> None:
    model = site_of(name).model
    spec = model.spec
    found: dict[str, set[str]] = {}
    for entry in index_of(site_of(name))["entries"]:
        found.setdefault(entry["kind"], set()).update([entry["title"], *entry.get("names", [])])
    expected: dict[str, set[str]] = {
        "message": set(spec.messages)
        | {str(each) for m in model.messages.values() for each in m.ids},
        "method": {f"{m.method.name}()" for m in spec.messages.values() if m.method is not None},
        "erratum": {erratum.title for erratum in spec.errata},
        "lookalike": {other.title for other in spec.lookalikes.values()},
        "page": set(spec.sources) | set(spec.endpoints),
        "frame": {each.title for m in spec.messages.values() for each in m.examples},
        "field": set(),
        "value": set(),
    }
    for message in model.messages.values():
        for slot in message.body:
            for field in slot.slots if isinstance(slot, Items) else [slot]:
                if field.field is not None:
                    expected["field"].add(field.name)
                    expected["value"] |= {*field.field.values, *field.field.bits}
    for kind, names in expected.items():
        assert names <= found.get(kind, set()), kind


@needs_node
@pytest.mark.each_protocol
@pytest.mark.parametrize("name", FILES)
def test_every_documented_frame_is_found_by_its_bytes(name: str) -> None:
    model = site_of(name).model
    frames = [
        (message.name, message.direction.key, list(example.hex))
        for message in model.messages.values()
        for example in message.message.examples
    ]
    program = """
    const bytesSearch = makeBytesSearch(asked.index);
    const answers = asked.frames.map(([, , bytes]) => bytesSearch.find(bytes).judged);
    """
    scripts = [*codec_scripts(model), "bytes_found"]
    asked = {"index": index_of(site_of(name)), "frames": frames}
    for (message, way, data), judged in zip(
        frames, run_script(scripts, program, asked), strict=True
    ):
        (mine,) = [each for each in judged if each["decoder"].endswith(f"&direction={way}")]
        assert mine["title"] == message, bytes(data).hex(" ")
        assert mine["path"] == f"{site_of(name).folder}messages/{message}.html"
        assert mine["hex"] == bytes(data).hex(" ").upper()
