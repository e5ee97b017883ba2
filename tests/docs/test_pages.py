"""The pages of the reference: whole, joined, without a network, and true to the spec."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from framegen.language.values import to_hex
from framegen.reading.yamltree import read_tree
from framegen.render import render

from tests.docs.reference import ROOT, SPECS, Reference, reference, reference_of, respelled

EVERY = [(name, path) for name in SPECS for path in reference(name).pages]
MESSAGES = [(name, message) for name in SPECS for message in reference(name).model.messages]


@pytest.fixture(params=SPECS)
def site(request: pytest.FixtureRequest) -> Reference:
    return reference(str(request.param))


@pytest.mark.parametrize(("name", "path"), EVERY)
def test_ids_are_unique(name: str, path: str) -> None:
    ids = reference(name).pages[path].ids
    assert sorted(ids) == sorted(set(ids))


@pytest.mark.parametrize(("name", "path"), EVERY)
def test_every_link_leads_somewhere(name: str, path: str) -> None:
    pages = reference(name).pages
    for link in pages[path].links:
        where, anchor = pages[path].leads_to(link)
        assert where in pages, link
        assert not anchor or anchor in pages[where].ids, link


@pytest.mark.parametrize(("name", "path"), EVERY)
def test_nothing_is_loaded_from_anywhere(name: str, path: str) -> None:
    page = reference(name).pages[path]
    assert page.loads == []
    for text in [*page.styles, *(script for _, script in page.scripts)]:
        assert "http:" not in text
        assert "https:" not in text
        assert "url(" not in text
        assert "@import" not in text


@pytest.mark.parametrize(("name", "path"), EVERY)
def test_headings_are_in_order_and_landmarks_are_there(name: str, path: str) -> None:
    page = reference(name).pages[path]
    assert page.headings[0] == 1
    assert page.headings.count(1) == 1
    for before, after in zip(page.headings, page.headings[1:], strict=False):
        assert after <= before + 1
    tags = [tag for tag, _ in page.tags]
    for landmark in ("header", "nav", "main", "footer"):
        assert tags.count(landmark) == 1, landmark


@pytest.mark.parametrize(("name", "path"), EVERY)
def test_the_footer_pins_the_spec(name: str, path: str) -> None:
    site = reference(name)
    footer = site.pages[path].text.partition("<footer>")[2]
    assert site.source.digest in footer
    assert f"spec version {site.model.spec.protocol.version}" in footer


def test_what_runs_is_what_the_policy_of_the_page_allows(site: Reference) -> None:
    for page in site.pages.values():
        policy = next(
            given["content"]
            for tag, given in page.tags
            if tag == "meta" and given.get("http-equiv") == "Content-Security-Policy"
        )
        assert policy.startswith("default-src 'none'; ")
        assert "unsafe" not in policy
        assert [given for _, given in page.tags if "style" in given] == []
        assert [name for _, given in page.tags for name in given if name.startswith("on")] == []


def test_style_and_scripts_keep_within_their_bounds() -> None:
    folder = ROOT / "codegen" / "framegen" / "targets" / "docs" / "static"
    assert len((folder / "style.css").read_text("utf-8").splitlines()) <= 300
    lines = [
        line.strip() for file in folder.glob("*.js") for line in file.read_text("utf-8").split("\n")
    ]
    assert len([line for line in lines if line and not line.startswith("//")]) <= 420
    assert max(map(len, lines)) <= 110


# ---------------------------------------------------------------------------- messages


@pytest.mark.parametrize(("name", "message"), MESSAGES)
def test_a_message_has_a_page_with_all_that_the_spec_says(name: str, message: str) -> None:
    site = reference(name)
    layout = site.model.messages[message]
    said, spec = layout.message, site.model.spec
    page = site.pages[f"messages/{message}.html"]
    words = " ".join(page.words.split())
    for text in [
        said.summary,
        *" ".join(said.description.split()).split(" . "),
        said.vendor_name,
        f"{layout.direction.sender} to {layout.direction.receiver}",
        f"{layout.frame.length_name} = {layout.formula}",
        f"{layout.largest} bytes",
        spec.sources[said.cite.source].title,
        said.cite.place,
        said.reply or "",
        *said.reports,
        said.since,
        said.deprecated,
    ]:
        assert text in words, text
    assert message in page.ids


@pytest.mark.parametrize(("name", "message"), MESSAGES)
def test_every_field_has_an_anchor_and_what_the_spec_says_of_it(name: str, message: str) -> None:
    site = reference(name)
    layout = site.model.messages[message]
    page = site.pages[f"messages/{message}.html"]
    words = " ".join(page.words.split())
    repeat = layout.repeat
    inner = () if repeat is None else repeat.fields
    for field in [*layout.numbers, *inner]:
        within = repeat is not None and repeat.element is not None and field in inner
        anchor = f"field-{repeat.name}-{field.name}" if repeat and within else f"field-{field.name}"
        assert anchor in page.ids
        said = field.field
        about = [value.about for value in said.values.values()]
        for text in [said.about, said.unit, *about, *(note.text for note in said.notes)]:
            assert text in words, text
        assert f"{field.low}..{field.high}" in words
        if said.limits is not None:
            assert f"A client sends {said.limits.usual} unless told otherwise" in words
        if said.signed_as is not None:
            assert f"The property signed_{field.name} has it as {said.signed_as}." in words
        for value in said.values.values():
            assert not value.absent or f"At {value.value} the property absent is true." in words


@pytest.mark.parametrize(("name", "message"), MESSAGES)
def test_the_link_to_the_spec_lands_on_the_line_of_the_message(name: str, message: str) -> None:
    site = reference(name)
    page = site.pages[f"messages/{message}.html"]
    anchors = [page.leads_to(link)[1] for link in page.links if "spec.html#" in link]
    assert site.source.line(int(anchors[0].removeprefix("L"))).strip() == f"{message}:"


@pytest.mark.parametrize("name", SPECS)
def test_the_spec_page_holds_the_spec_to_the_letter(name: str) -> None:
    site = reference(name)
    text = site.pages["spec.html"].words
    for number, line in enumerate(site.source.text.rstrip("\n").split("\n"), 1):
        assert f"{number}{line}\n" in text


@pytest.mark.parametrize(("name", "message"), MESSAGES)
def test_every_example_is_there_twice_and_can_be_copied(name: str, message: str) -> None:
    site = reference(name)
    for path in (f"messages/{message}.html", "examples.html"):
        page = site.pages[path]
        copied = [given["data-copy"] for tag, given in page.tags if tag == "button"]
        for example in site.model.messages[message].message.examples:
            assert example.title in page.words
            assert to_hex(example.hex) in copied
            assert f'bytes.fromhex("{to_hex(example.hex)}")' in copied


def test_requests_and_replies_are_paired() -> None:
    page = reference("busservo").pages["examples.html"].words
    order = [
        "Run action group 8 once",
        "Action group 8 has started, to run once",
        "Action group 8 has ended after one run",
        "Run action group 2 until it is stopped",
        "Action group 2 has started, to run until it is stopped",
        "Ask for the battery voltage",
        "The battery is at 7500 mV",
        "Ask for the positions of servos 1 to 6",
        "Servos 1 to 6 are all at position 500",
    ]
    places = [page.index(title) for title in order]
    assert places == sorted(places)


@pytest.mark.parametrize("message", reference("busservo").model.messages)
def test_the_python_of_a_message_runs(message: str) -> None:
    site = reference("busservo")
    (snippet,) = site.pages[f"messages/{message}.html"].python
    done = subprocess.run(
        [sys.executable, "-c", snippet],
        env={"PYTHONPATH": str(ROOT / "generated")},
        capture_output=True,
        encoding="utf-8",
        check=False,
    )
    assert done.returncode == 0, done.stderr
    promised = [line.partition("# ")[2] for line in snippet.splitlines() if "# " in line]
    assert [line for line in promised if line not in done.stdout.splitlines()] == []
    receives = site.model.messages[message].direction.sender != "host"
    assert bool(done.stdout) == receives
    assert f"```python\n{snippet}```" in site.files[f"messages/{message}.md"]


# ---------------------------------------------------------------------------- the rest


def test_the_index_lists_every_message_by_code(site: Reference) -> None:
    rows = [given for tag, given in site.pages["index.html"].tags if tag == "tr" and given]
    found = [(row["data-codes"].split()[0], row["data-words"].split()[0]) for row in rows]
    messages = sorted(site.model.messages.values(), key=lambda message: message.id)
    assert found == [(str(message.id), message.name.lower()) for message in messages]


def test_errata_look_alikes_and_history_are_told(site: Reference) -> None:
    spec = site.model.spec
    errata = " ".join(site.pages["errata.html"].words.split())
    for erratum in spec.errata:
        for text in (erratum.title, erratum.here, erratum.why):
            assert text in errata
    for unknown in spec.unknowns:
        assert unknown.what in errata
    lookalikes = " ".join(site.pages["lookalikes.html"].words.split())
    for other in spec.lookalikes.values():
        assert " ".join(other.about.split()) in lookalikes.replace(" . ", ". ")
        for example in other.examples:
            for byte in to_hex(example.hex).split():
                assert byte in lookalikes
    changelog = " ".join(site.pages["changelog.html"].words.split())
    for release in spec.history:
        assert release.version in changelog
        for change in release.changes:
            assert change in changelog


def test_wire_times_are_those_of_the_line() -> None:
    words = " ".join(reference("busservo").pages["sequences.html"].words.split())
    # Six servos: 11 bytes asked, 23 answered, at 960 bytes a second.
    assert "6 items in servo_ids 34 35.4 ms" in words
    # A move of six servos is not documented; one of two has 13 bytes.
    assert "2 items in targets 13 13.5 ms" in words


def test_the_data_of_the_decoder_is_the_layout(site: Reference) -> None:
    (data,) = [
        json.loads(text)
        for given, text in site.pages["decoder.html"].scripts
        if given.get("type") == "application/json"
    ]
    assert [message["name"] for message in data["messages"]] == list(site.model.messages)
    for message in data["messages"]:
        layout = site.model.messages[message["name"]]
        lengths = message["lengths"]
        assert range(lengths["first"], lengths["last"] + 1, lengths["step"]) == layout.lengths


def test_a_spec_with_nothing_optional_has_a_reference() -> None:
    data = read_tree(reference("busservo").source)[0].data
    for key in ("errata", "unknowns", "lookalikes", "reserved", "history", "pose"):
        del data[key]
    needless = ("description", "vendor_name", "reply", "reports", "echoed", "acknowledged")
    for message in data["messages"].values():
        for key in (*needless, "method", "lasts"):
            message.pop(key, None)
    site = reference_of(respelled(data))
    assert "No errata are known." in site.pages["errata.html"].words
    assert "No look-alikes are known." in site.pages["lookalikes.html"].words
    assert "Kept free" not in site.pages["index.html"].words
    assert all(text.endswith("\n") for text in site.files.values())


@pytest.mark.parametrize("name", SPECS)
def test_rendering_twice_gives_the_same_and_needs_no_folder(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    site = reference(name)
    monkeypatch.chdir(tmp_path)
    first, second = (render(site.compiled) for _ in range(2))
    assert first == second
    assert list(tmp_path.iterdir()) == []
    assert "docs/reference" in first.folders
