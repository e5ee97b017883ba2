"""Downloads: what a reference is made of, and what its page says of each file."""

import json
import re
from pathlib import Path

import pytest
from framegen.compile import compile_spec
from framegen.language.load import read_source
from framegen.reading.source import Source
from framegen.reading.yamltree import Unusable
from framegen.render import render, render_shared
from framegen.site.downloads import size_in_words
from framegen.site.guides.linked_files import linked_files
from framegen.site.project import read_project
from framegen.site.recordings import recordings_of

from tests.factories import BUSSERVO, compiled_file, write_files
from tests.in_turn import in_turn
from tests.unit.site.editions import FIRST, SECOND, THIRD, Editions, three
from tests.unit.site.reference import ROOT, Page

FOLDER = "reference/lamps/downloads/"


def rows(page: Page) -> dict[str, tuple[str, str]]:
    """Return the files that the page lists by their links: sizes, and what they are."""
    found = re.findall(
        r'<tr><th scope="row"><a href="([^"]*)" download>[^<]*</a></th>'
        r'<td class="number">([^<]*)</td><td>(.*?)</td></tr>',
        page.text,
    )
    return {link: (size, re.sub(r"<[^>]*>", "", about)) for link, size, about in found}


def test_every_file_is_listed_with_its_size() -> None:
    page = three().page("downloads.html")
    listed = {page.leads_to(link)[0]: size for link, (size, _) in rows(page).items()}
    files = {path: text for path, text in three().rendered.items() if path.startswith(FOLDER)}
    assert listed.keys() == files.keys()
    for path, text in files.items():
        assert listed[path] == size_in_words(len(text.encode())), path


def test_the_spec_is_what_the_edition_says() -> None:
    for folder, text in (("", THIRD), ("2.0.0/", SECOND), ("1.0.0/", FIRST)):
        assert three().rendered[f"reference/lamps/{folder}downloads/lamps.yaml"] == text
    helper = three().rendered[f"{FOLDER}framegen.schema.json"]
    compiled = compile_spec(Source("spec/lamps.yaml", THIRD))
    assert [helper] == [*render_shared(compiled).files.values()]


def test_vectors_and_markdown_are_those_of_the_project() -> None:
    """But for the way to the spec, which lies beside them."""
    files = render(compile_spec(Source("spec/lamps.yaml", THIRD))).files
    rendered = three().rendered
    assert rendered[f"{FOLDER}vectors.json"] == files["generated/lamps/vectors.json"]
    pages = {path for path in files if path.startswith("docs/reference/lamps/")}
    assert len(pages) > 8
    for path in pages:
        own = rendered[FOLDER + path.removeprefix("docs/reference/lamps/")]
        assert own == files[path].replace("../../../spec/lamps.yaml", "lamps.yaml")


def test_a_message_page_leads_to_its_markdown() -> None:
    for folder, name in (("", "LampLevel"), ("1.0.0/", "LampState")):
        page = three().page(f"{folder}messages/{name}.html")
        assert f"reference/lamps/{folder}downloads/messages/{name}.md" in page.reached


def test_the_page_counts_the_vectors() -> None:
    vectors = json.loads(three().rendered[f"{FOLDER}vectors.json"])
    listed = rows(three().page("downloads.html")).items()
    (about,) = [about for link, (_, about) in listed if link.endswith("vectors.json")]
    many = [len(vectors[kind]) for kind in ("valid", "unencodable", "invalid", "streams")]
    assert [int(number) for number in re.findall(r"\d+", about)] == many


def test_sizes_are_said_as_people_say_them() -> None:
    sizes = {0: "0 bytes", 1: "1 byte", 999: "999 bytes", 1000: "1.0 kB", 9300: "9.3 kB"}
    sizes |= {217952: "218 kB", 1_500_000: "1.5 MB"}
    assert {size: size_in_words(size) for size in sizes} == sizes


@pytest.fixture
def docs(tmp_path: Path) -> Path:
    """Return the folder of the guides in a project with some other files."""
    root = tmp_path / "project"
    paths = [
        *("docs/README.md", "lines/noisy.bin", "lines/noisy.md", "lines/other.bin", "README.md"),
        *("spec/lamps.yaml", ".secret/key.bin", "lines/.hidden", "lines/two words.bin"),
    ]
    write_files({path: path for path in [*paths, "../outside.bin"]}, root)
    (root / "lines" / "way out.bin").symlink_to(tmp_path / "outside.bin")
    return root / "docs"


@in_turn(
    "text, files",
    lambda: [
        ("[a](../lines/noisy.bin)", ["lines/noisy.bin", "lines/noisy.md"]),
        ("[a]\n\n[a]: ../lines/other.bin", ["lines/other.bin"]),
        ("[a](../lines/two%20words.bin#x)", ["lines/two words.bin"]),
        ("`[a](../lines/other.bin)`", []),
        ("```sh\ncat ../lines/other.bin\n```", []),
        ("[a](../lines/missing.bin) [b](../lines) [c](..) [d](../)", []),
        ("[a](../README.md) [b](../spec/lamps.yaml)", []),
        ("[a](../.secret/key.bin) [b](../lines/.hidden)", []),
        ("[a](../../outside.bin) [b](../lines/../../outside.bin)", []),
        ("[a](<../lines/way out.bin>)", []),
        ("[a](../%2e%2e/outside.bin) [b](../lines/%00.bin)", []),
    ],
)
def test_what_guides_link_to_is_published(docs: Path, text: str, files: list[str]) -> None:
    found = linked_files({"README.md": text}, docs)
    assert found == {f"files/{path}": path.encode() for path in files}


def test_a_file_that_is_too_large_is_named(docs: Path) -> None:
    with (docs / "../lines/other.bin").open("wb") as file:
        file.truncate(10_000_001)
    with pytest.raises(Unusable, match=r"other\.bin is too large for the site"):
        linked_files({"README.md": "[a](../lines/other.bin)"}, docs)


def test_the_recordings_of_this_project_are_of_the_protocol_whose_frames_they_hold() -> None:
    specs = {ROOT / "spec" / f"{name}.yaml": name for name in ("busservo", "lxservo")}
    project = read_project({file: compiled_file(file) for file in specs}, ROOT / "docs")
    found = [[each.path for each in recordings_of(it.model, project.files)] for it in project.specs]
    captures = [f"files/tests/captures/{name}" for name in ("cut_off.hex", "noisy_line.bin")]
    assert dict(zip(specs.values(), found, strict=True)) == {"busservo": captures, "lxservo": []}


def test_a_recording_is_told_by_what_it_holds() -> None:
    model = compile_spec(read_source(BUSSERVO)).model
    frame = bytes.fromhex("55 55 02 0F")
    files = {
        "files/a.bin": frame * 3,
        "files/a.md": b"Three questions.",
        "files/b.hex": b"55 55 02 0F  # a question\n",
        "files/noise.bin": frame + bytes(5),
        "files/text.txt": b"No bytes at all.\n",
        "files/empty.bin": b"",
        "images/c.bin": frame,
    }
    found = recordings_of(model, files)
    assert [each.name for each in found] == ["a.bin", "b.hex"]
    assert [each.about for each in found] == ["files/a.md", ""]
    kinds = len(model.messages)
    assert found[0].summary.startswith(f"12 bytes, 3 messages, 1 of {kinds} kinds seen")


def test_recordings_are_on_the_page_and_their_links_lead_somewhere() -> None:
    frame = bytes.fromhex("AA 55 04 07 01 01 64")
    files = (("files/lines/noisy line.bin", frame), ("files/lines/noisy line.md", b"# It\n"))
    guides = (("README.md", "# Lamps\n"), ("lines.md", "# L\n\n[one](<../lines/noisy line.bin>)\n"))
    site = Editions(FIRST, (), guides, files)
    page = site.page("downloads.html")
    assert {"files/lines/noisy%20line.bin", "files/lines/noisy%20line.md"} <= page.reached
    assert "7 bytes, 1 message" in page.words
    assert "lamps decode --direction any 'noisy line.bin'" in page.words
    assert "files/lines/noisy%20line.bin" in site.pages["lines.html"].reached
