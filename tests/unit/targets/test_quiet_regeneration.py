"""Only what changed changes: a comment nothing, a word a few files, a message what shows it.

Nothing else than the spec does: tests/world/test_deterministic.py holds that other folders,
locales, hash orders and Pythons give the same bytes.
"""

import ast
import json
import os
import re
import sys
from functools import cache
from pathlib import Path

import framegen
import pytest
from framegen.compile import Compiled, compile_spec
from framegen.language.load import read_source
from framegen.output import Output
from framegen.reading.source import Source
from framegen.render import render, render_target, snippets
from framegen.site.project import Project
from framegen.site.site import render_site
from framegen.targets import docs, python
from framegen.targets.table import TARGETS

from tests.factories import BUSSERVO, DEMO, NEW_MESSAGE, ROOT, Data, Steps, compiled_file, data_of
from tests.in_turn import in_turn
from tests.mutations.places import at, texts, with_
from tests.mutations.places import changed as reworded
from tests.mutations.prose import PROSE, is_prose
from tests.rows import Rows

SPECS = {"busservo": BUSSERVO, "greenhouse": DEMO}
PATH = "spec/some.yaml"

# A unit, a vendor's name and a version are facts: they may be code.
FACTS = {"unit", "vendor_name", "cite"}
# What is said of one thing, and shown where that thing is.
OF_ONE_THING = PROSE - FACTS - {"title", "changes"}
MOST = 8

# Modules that hold the words which the command prints; all else has words in docstrings alone.
FOR_READERS = {"_command.py", "_lookalikes.py"}


def compiled(text: str) -> Compiled:
    found = compile_spec(Source(PATH, text))
    assert [finding.message for finding in found.findings] == []
    return found


@cache
def files(text: str) -> dict[str, str]:
    return render(compiled(text)).files


@cache
def modules_and_pages(text: str) -> dict[str, str]:
    """Return the files that hold words; the vectors, which take longer, hold titles alone."""
    spec = compiled(text)
    return render_target(python.TARGET, spec) | render_target(docs.TARGET, spec)


@cache
def text_of(name: str) -> str:
    return SPECS[name].read_text(encoding="utf-8")


def as_text(data: Data) -> str:
    """Return a spec as text: JSON is YAML, too."""
    return json.dumps(data, indent=1)


@cache
def in_json(name: str) -> str:
    return as_text(data_of(SPECS[name]))


def changed(before: dict[str, str], after: dict[str, str]) -> set[str]:
    """Return the paths of the files that come, go or differ."""
    paths = before.keys() | after.keys()
    return {path for path in paths if before.get(path) != after.get(path)}


def commented(text: str) -> str:
    """Return the same spec with comments and blank lines wherever they can be."""
    for line, comment in (
        (r"^framegen:", "# what this file is\n\n\n"),
        (r"^\w+:$", "# what is next\n"),
        (r"^  [A-Z]\w+:$", "  # a message\n\n"),
        (r"^    fields:$", "    # its fields\n"),
        (r"\Z", "# the end\n"),
    ):
        found = re.sub(line, rf"{comment}\g<0>", text, flags=re.MULTILINE)
        assert found != text
        text = found
    return text


@pytest.mark.parametrize("name", SPECS)
def test_neither_a_comment_nor_how_values_are_spelt_changes_a_file(name: str) -> None:
    """In JSON nothing stands where it stood, and no line has the number that it had."""
    text = text_of(name)
    assert changed(files(text), files(commented(text))) == set()
    assert changed(files(text), files(in_json(name))) == set()


@pytest.mark.parametrize("name", SPECS)
def test_a_comment_changes_only_what_shows_the_spec(name: str) -> None:
    text = text_of(name)
    site, after = (
        render_site(Project([compiled(each)]), snippets()) for each in (text, commented(text))
    )
    shown = {f"reference/{name}/{path}" for path in ("spec.html", f"downloads/{name}.yaml")}
    # Among the downloads, the size of that one may be another.
    downloads = f"reference/{name}/downloads.html"
    for each in (site, after):
        each[downloads] = re.sub(r"[0-9.]+ kB", "", str(each[downloads]))
    assert changed(site, after) == shown


@pytest.mark.parametrize("name", SPECS)
def test_no_file_knows_the_digest_of_the_spec_or_who_generated_it_when(name: str) -> None:
    """But for the pages, which are not committed: below each stands what has built it."""
    source = Source(PATH, text_of(name))
    pages = render_site(Project([compiled(source.text)]), snippets())
    for path, text in (files(source.text) | pages).items():
        assert source.digest not in text, path
        assert path.endswith(".html") or f"framegen {framegen.__version__}" not in text, path


@cache
def kinds_of_prose(name: str) -> dict[str, Steps]:
    """Return, for each kind of place with a description, the last such place."""
    known = {"messages", "fields", "values", "notes", "examples", "errata", "unknowns", "sources"}
    found = {}
    for path, _ in texts(data_of(SPECS[name])):
        if path[-1] not in OF_ONE_THING:
            continue
        names = [
            "*" if isinstance(step, int) or before in known else step
            for before, step in zip(("", *path), path, strict=False)
        ]
        found[".".join(names)] = path
    return found


# Each kind in one spec: busservo has more messages, and so more files that might change with it.
PLACES = [
    (name, kind)
    for kind, name in {
        kind: name for name in reversed(SPECS) for kind in kinds_of_prose(name)
    }.items()
]


def test_prose_stands_in_many_places() -> None:
    kinds = {kind for _, kind in PLACES}
    assert {
        *("frame.header.about", "messages.*.summary", "messages.*.description"),
        *("messages.*.fields.*.about", "messages.*.fields.*.notes.*.text"),
        *("messages.*.fields.*.fields.*.about", "messages.*.fields.*.values.*.about"),
        *("sources.*.about", "errata.*.why"),
    } <= kinds


@pytest.mark.parametrize("first", Rows([0], others=[1, 2]))
@in_turn("name, kind", lambda first: PLACES[first::3])
def test_a_changed_word_changes_few_files(first: int, name: str, kind: str) -> None:
    data = data_of(SPECS[name])
    before = modules_and_pages(in_json(name))
    path = kinds_of_prose(name)[kind]
    data = with_(data, *path, f"Indeed, {at(data, path)}")
    touched = changed(before, modules_and_pages(as_text(data)))
    # What is noted of an end is shown with every message that it receives.
    received = len(data["messages"]) if kind.startswith("endpoints.") else 0
    assert 1 <= len(touched) <= MOST + received, touched


def in_other_words(path: Steps, text: str) -> str:
    return f"Indeed, {text}" if is_prose(path) and path[-1] not in FACTS else text


@cache
def reworded_json(name: str) -> str:
    """Return the same facts in other words."""
    return as_text(reworded(data_of(SPECS[name]), in_other_words))


class _Bare(ast.NodeTransformer):
    """A transformer that drops docstrings, attributes' included, and optionally all strings."""

    def __init__(self, *, strings: bool) -> None:
        self._strings = strings

    def visit_Expr(self, node: ast.Expr) -> ast.AST | None:
        is_docstring = isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)
        return None if is_docstring else self.generic_visit(node)

    def visit_Assign(self, node: ast.Assign) -> ast.AST | None:
        # What the warning says of a deprecated message is words, too.
        named = [target.id for target in node.targets if isinstance(target, ast.Name)]
        return None if named == ["DEPRECATED"] else self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        if self._strings and isinstance(node.value, str):
            node.value = ""
        return node


def bare(path: str, text: str) -> str:
    """Return the code of a module without docstrings, and without words that the command prints."""
    strings = any(path.endswith(f"/{name}") for name in FOR_READERS)
    return ast.dump(_Bare(strings=strings).visit(ast.parse(text)))


@pytest.mark.parametrize("name", SPECS)
def test_other_words_leave_the_code_and_the_vectors_as_they_are(name: str) -> None:
    """But for the titles."""
    before, after = files(in_json(name)), files(reworded_json(name))
    assert before.keys() == after.keys()
    touched = {path for path in changed(before, after) if path.endswith(".py")}
    assert {f"generated/{name}/messages.py", f"generated/{name}/_command.py"} <= touched
    for path in touched:
        assert bare(path, before[path]) == bare(path, after[path]), path
    one, other = (
        re.sub(r'"title": "(?:[^"\\]|\\.)*"', '"title": ""', each[f"generated/{name}/vectors.json"])
        for each in (before, after)
    )
    assert one == other


def test_a_new_message_changes_what_shows_it_and_few_vectors_of_others() -> None:
    text = text_of("busservo")
    # Before the line above the messages of the controller.
    where = text.index("  # -----", text.index("  ServoUnload:"))
    new = text[:where] + NEW_MESSAGE + text[where:]
    touched = changed(files(text), files(new))
    pages = {"README.md", "examples.md", "messages/HornBlow.md", "sequences.md"}
    modules = {
        *("__init__.py", "__init__.pyi", "messages.py", "strategies.py", "vectors.json"),
        *(f"_{name}.py" for name in ("exchanges", "controller", "async_controller")),
        *("device.py", "_command.py", "protocol.json", "tables.py"),
    }
    assert touched == {f"docs/reference/busservo/{page}" for page in pages} | {
        f"generated/busservo/{module}" for module in modules
    }
    vectors = "generated/busservo/vectors.json"
    before, after = (files(each)[vectors].splitlines() for each in (text, new))
    gone = [json.loads(line.rstrip(","))["title"] for line in before if line not in after]
    # Unless there were so many that these lines did not change either.
    assert set(gone) <= {
        "one frame of each message in one piece",
        "one frame of each message in pieces of 7 bytes",
    }
    kept = [line for line in after if line in before]
    assert kept == [line for line in before if line in after]


def test_a_new_named_value_changes_what_shows_it() -> None:
    before = files(in_json("busservo"))
    values = {"a_second": {"value": 1000, "about": "A second."}}
    field = ("messages", "ServoMove", "fields", "time_ms")
    data = with_(data_of(BUSSERVO), *field, "values", values)
    assert changed(before, files(as_text(data))) == {
        *("docs/reference/busservo/examples.md", "docs/reference/busservo/messages/ServoMove.md"),
        *("generated/busservo/_async_controller.py", "generated/busservo/_controller.py"),
        *("generated/busservo/protocol.json", "generated/busservo/messages.py"),
    }


def test_a_new_version_changes_what_states_it() -> None:
    text = text_of("busservo")
    version = data_of(BUSSERVO)["protocol"]["version"]
    later = text.replace(f"version: {version}", "version: 99.0.0")
    later = later.replace(f'"{version}"', '"99.0.0"')
    assert changed(files(text), files(later)) == {
        "docs/reference/busservo/README.md",
        "docs/reference/busservo/changelog.md",
        "generated/busservo/_library.py",
        "generated/busservo/vectors.json",
    }


@cache
def rendered(name: str) -> Output:
    return render(compiled_file(SPECS[name]))


@pytest.mark.parametrize("name", SPECS)
def test_rendering_twice_gives_the_same_and_touches_no_disk(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    # The spec is also read once more.
    assert render(compile_spec(read_source(SPECS[name]))) == rendered(name)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", SPECS)
def test_no_file_holds_where_when_or_by_whom_it_was_made(name: str) -> None:
    forbidden = [str(ROOT), str(Path.home()) + os.sep, sys.prefix, os.sep + "home" + os.sep]
    for path, text in rendered(name).files.items():
        assert [word for word in forbidden if word in text] == [], path


@pytest.mark.parametrize("name", SPECS)
def test_every_file_ends_in_one_line_feed_and_holds_nothing_unseen(name: str) -> None:
    for path, text in rendered(name).files.items():
        assert text == "" or (text.endswith("\n") and not text.endswith("\n\n")), path
        assert text.replace("\n", "").isprintable(), path
        assert [line for line in text.split("\n") if line != line.rstrip()] == [], path


def test_no_two_targets_write_the_same_file() -> None:
    compiled = compiled_file(DEMO)
    paths = [path for target in TARGETS for path in target.render(compiled, snippets())]
    assert len(paths) == len(set(paths))
