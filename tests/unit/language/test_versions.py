"""Versions of specs, paths into them, and former names, which change nothing that is generated."""

from itertools import pairwise
from shutil import which
from typing import Any

import pytest
from framegen.checks.named import families, former_names
from framegen.language.paths import NoPath, expect_place, read_path
from framegen.language.version import NoVersion, Version
from framegen.reading.yamltree import dotted
from framegen.render import render
from hypothesis import given
from hypothesis import strategies as st

from tests.bad_specs import BASES
from tests.factories import BUSSERVO, DEMO, ROOT, Data, compiled_file, compiled_of, data_of
from tests.in_turn import in_turn
from tests.mutations.places import nodes
from tests.programs import ran

# In the order of semver.org, section 11.
ORDERED = [
    *("0.0.1", "0.1.0", "0.9.0", "0.10.0", "1.0.0-alpha.0", "1.0.0-alpha.2", "1.0.0-alpha.10"),
    *("1.0.0-beta.1", "1.0.0-rc.1", "1.0.0", "1.0.1", "1.2.0", "1.10.0", "2.0.0-rc.1", "2.0.0"),
]

ANY = 'write three numbers, such as "1.0.0"; only -alpha.1, -beta.1 or -rc.1 may follow'
NO_VERSIONS = [
    *("", "1.0.0-rc", "1.0.0-dev.1", "1.0.0+7", "1.0.0.0", "\u0661.0.0", "1." * 400, "9" * 5000),
    *("1.0.0-rc.01", "one"),
]


def test_versions_are_in_the_order_of_semantic_versions() -> None:
    assert sorted({*ORDERED}, key=Version.parse) == ORDERED
    assert all(Version.parse(low) < Version.parse(high) for low, high in pairwise(ORDERED))


@in_turn("text", lambda: ORDERED)
def test_a_version_is_written_as_it_was_read(text: str) -> None:
    version = Version.parse(text)
    assert str(version) == text
    assert version.is_final == ("-" not in text)
    assert str(version.final) == text.partition("-")[0]


@in_turn(
    "text, hint",
    lambda: [
        ("1", 'write "1.0.0"'),
        ("1.2", 'write "1.2.0"'),
        ("v1.2.3", 'write "1.2.3"'),
        ("01.2.3", 'write "1.2.3"'),
        ("1.0.0\n", 'write "1.0.0"'),
        *((text, ANY) for text in NO_VERSIONS),
    ],
)
def test_what_is_no_version_is_refused_with_what_to_write(text: str, hint: str) -> None:
    with pytest.raises(NoVersion) as refused:
        Version.parse(text)
    assert (str(refused.value), refused.value.hint) == (f"`{text}` is no semantic version", hint)
    assert Version.parse_or_none(text) is None


@pytest.mark.parametrize(
    "file",
    [BUSSERVO, DEMO, ROOT / "tests" / "specs" / "everything.yaml", BASES / "bus.yaml"],
    ids=lambda file: file.stem,
)
def test_every_place_of_a_spec_has_a_path_that_is_read_back(file: Any) -> None:
    found: list[Any] = [path for path, _ in nodes(data_of(file))]
    assert len(found) > 100
    for path in found:
        # The short form of bits, the names of other devices, and elements of notations.
        if any("." in step or "[" in step for step in path if isinstance(step, str)):
            continue
        assert read_path(dotted(path)) == path
        # A notation is one value to the language, whatever its author wrote it as.
        if path[-2:-1] not in {("was",), ("length",)}:
            expect_place(path)


@given(st.text(st.sampled_from("ab.[]0 1"), max_size=9))
def test_what_is_read_as_a_path_is_written_as_it_was(text: str) -> None:
    try:
        path = read_path(text)
    except NoPath:
        return
    assert read_path(dotted(path)) == path
    assert dotted(path).replace("[0", "[") == text.replace("[0", "[")


@in_turn(
    "text, message",
    lambda: [
        ("", "`` is no path into a spec"),
        ("[0]", "`[0]` is no path into a spec"),
        ("messages.", "`messages.` is no path into a spec"),
        ("messages[0]", "`messages` has no `0`"),
        ("link.bauds", "`link` has no `bauds`"),
        ("messages.X.fields.y.z", "`messages.X.fields.y` has no `z`"),
        ("messages.X.summary.y", "`messages.X.summary` has no `y`"),
        ("baud", "a spec has no `baud`"),
    ],
)
def test_what_leads_nowhere_is_refused(text: str, message: str) -> None:
    with pytest.raises(NoPath) as refused:
        expect_place(read_path(text))
    assert str(refused.value) == message


def with_former_names(data: Data) -> Data:
    """Return a spec in which everything that can have had another name had one, or two."""
    compiled = compiled_of(data)
    changed: Data = compiled.tree.data
    for number, (path, named) in enumerate(families(compiled.spec)):
        for name, thing in named.items():
            if not hasattr(thing, "was"):
                continue
            around: Any = changed
            for step in path:
                around = around[step]
            former = f"Was{name}" if path == ("messages",) else f"was_{name}"
            if not isinstance(around[name], dict):
                around[name] = {"at": around[name]}
            around[name]["was"] = [former, f"{former}2"] if number % 2 else former
    return changed


def test_former_names_and_accepted_breaks_change_nothing_that_is_generated() -> None:
    data = data_of(ROOT / "tests" / "specs" / "everything.yaml")
    version = data["protocol"]["version"]
    data.setdefault("history", [{"version": version, "changes": ["It."]}])
    changed = with_former_names(data)
    changed["history"][0]["breaks"] = {"messages.Gone": "Nobody has it.", "link.baud": "Faster."}
    before, after = compiled_of(data), compiled_of(changed)
    assert after.findings == []
    had = [
        [*former_names((*path, name), thing)]
        for path, named in families(after.spec)
        for name, thing in named.items()
    ]
    assert len([*filter(None, had)]) > 5
    assert render(after).files == render(before).files


def test_a_released_edition_is_what_its_name_says() -> None:
    """Editions are kept for comparisons: an edit would change what was compared before."""
    for spec in sorted((ROOT / "spec").glob("*.yaml")):
        name = compiled_file(spec).spec.protocol.name
        editions = sorted((ROOT / "spec" / "released").glob(f"{name}-*.yaml"))
        assert editions, name
        for file in editions:
            protocol = data_of(file)["protocol"]
            assert f"{protocol['name']}-{protocol['version']}" == file.stem
            ours = compiled_file(spec).spec.protocol.version
            assert Version.parse(protocol["version"]) <= Version.parse(ours)


@pytest.mark.skipif(which("git") is None, reason="there is no git here")
def test_a_released_edition_was_never_edited() -> None:
    folder = "spec/released"
    if git("rev-parse", "--is-inside-work-tree") != "true\n":
        pytest.skip("this is no clone")
    assert git("log", "--diff-filter=MD", "--format=%h %s", "--", folder) == ""
    assert git("diff", "--name-only", "--diff-filter=MD", "HEAD", "--", folder) == ""


def git(*words: str) -> str:
    return ran("git", *words, status=None, cwd=ROOT).stdout
