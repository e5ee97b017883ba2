"""The words that name editions: files, released editions, git revisions, and what is wrong."""

import io
import sys
from pathlib import Path
from shutil import copytree
from typing import TypeAlias

import pytest
from framegen.comparison.editions import Editions, find_editions
from framegen.comparison.listing import edition_of, released
from framegen.compile import compile_leniently, compile_spec
from framegen.language.load import MAX_BYTES
from framegen.reading.source import Source
from framegen.reading.yamltree import Unusable

from tests.factories import BUSSERVO, DEMO, ROOT, write_files
from tests.in_turn import in_turn
from tests.repository import ALONE, OF_A_HOOK, commit, git, start

Patch: TypeAlias = pytest.MonkeyPatch
Found: TypeAlias = list[tuple[str, str, str]]

LAMPS = (ROOT / "tests" / "specs" / "lamp.yaml").read_text(encoding="utf-8")
BLINDS = (ROOT / "tests" / "specs" / "blinds.yaml").read_text(encoding="utf-8")


def version(text: str, number: str) -> str:
    """Return a spec that gives itself another version."""
    head, _, rest = text.partition("version: ")
    return f'{head}version: "{number}"\n{rest.partition(chr(10))[2]}'


def release(project: Path, *numbers: str) -> None:
    kept = {f"spec/released/stage_lamp-{each}.yaml": version(LAMPS, each) for each in numbers}
    write_files(kept, project)


@pytest.fixture(scope="module")
def origin(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a project with two specs, of which one was tagged, moved, and changed since."""
    folder = tmp_path_factory.mktemp("origin")
    start(folder)
    commit(folder, {"spec/old_lamp.yaml": version(LAMPS, "0.1.0")}, "v0.1.0")
    git(folder, "mv", "spec/old_lamp.yaml", "spec/lamp.yaml")
    commit(folder, {"spec/lamp.yaml": version(LAMPS, "0.2.0")}, "v0.2.0")
    commit(folder, {"spec/lamp.yaml": version(LAMPS, "0.3.0"), "spec/blinds.yaml": BLINDS})
    (folder / "spec" / "lamp.yaml").write_text(version(LAMPS, "0.4.0"), encoding="utf-8")
    git(folder, "add", "--all")
    (folder / "spec" / "lamp.yaml").write_text(version(LAMPS, "0.5.0"), encoding="utf-8")
    (folder / "docs").mkdir()
    return folder


@pytest.fixture
def alone(monkeypatch: Patch) -> None:
    """Have the command run git as the tests do."""
    for name, value in ALONE.items():
        monkeypatch.setenv(name, value)
    for name in OF_A_HOOK:
        monkeypatch.delenv(name, raising=False)


@pytest.fixture
def clone(origin: Path, alone: None, monkeypatch: Patch) -> Path:
    """Return that project, which is the current folder, and stays as it is."""
    monkeypatch.chdir(origin)
    return origin


@pytest.fixture
def copy(origin: Path, alone: None, tmp_path: Path, monkeypatch: Patch) -> Path:
    """Return a copy of it, which can be changed."""
    copytree(origin, tmp_path / "copy")
    monkeypatch.chdir(tmp_path / "copy")
    return tmp_path / "copy"


def versions(*words: str | None) -> Found:
    """Return the protocols that words name, each with the versions of its two editions."""
    return [
        (new.spec.protocol.name, old.version, new.version)
        for old, new in find_editions(*words).pairs
    ]


BLINDS_VERSION = compile_spec(Source("blinds.yaml", BLINDS)).spec.protocol.version
BOTH_BLINDS = ("blinds", BLINDS_VERSION, BLINDS_VERSION)


def lamp(old: str, new: str) -> tuple[str, str, str]:
    return "stage_lamp", old, new


@in_turn(
    "words, found",
    lambda: [
        ("", [BOTH_BLINDS, lamp("0.3.0", "0.5.0")]),
        *(("HEAD", [BOTH_BLINDS, lamp("0.3.0", "0.5.0")]), ("v0.2.0", [lamp("0.2.0", "0.5.0")])),
        *(("v0.1.0", [lamp("0.1.0", "0.5.0")]), ("v0.1.0 lamp", [lamp("0.1.0", "0.5.0")])),
        *(("v0.1.0 HEAD", [lamp("0.1.0", "0.3.0")]), ("v0.2.0 HEAD", [lamp("0.2.0", "0.3.0")])),
        ("HEAD~1 main", [lamp("0.2.0", "0.3.0")]),
        ("v0.1.0:spec/old_lamp.yaml", [lamp("0.1.0", "0.5.0")]),
        ("v0.1.0:./spec/old_lamp.yaml v0.2.0", [lamp("0.1.0", "0.2.0")]),
        (":spec/lamp.yaml", [lamp("0.4.0", "0.5.0")]),
        ("v0.2.0:spec/lamp.yaml :spec/lamp.yaml", [lamp("0.2.0", "0.4.0")]),
        *(("lamp", [lamp("0.3.0", "0.5.0")]), ("spec/blinds.yaml", [BOTH_BLINDS])),
        ("HEAD lamp", [lamp("0.3.0", "0.5.0")]),
        ("HEAD spec/lamp.yaml", [lamp("0.3.0", "0.5.0")]),
        ("spec/lamp.yaml HEAD", [lamp("0.5.0", "0.3.0")]),
        ("lamp blinds", [("blinds", "0.5.0", BLINDS_VERSION)]),
    ],
)
def test_words_name_editions(clone: Path, words: str, found: Found) -> None:
    assert versions(*words.split()) == found


def test_a_folder_within_the_project_finds_the_same(clone: Path, monkeypatch: Patch) -> None:
    monkeypatch.chdir(clone / "docs")
    assert versions("v0.2.0") == [("stage_lamp", "0.2.0", "0.5.0")]
    ((old, new),) = find_editions("v0.2.0").pairs
    assert (old.label, new.label) == ("v0.2.0:spec/lamp.yaml", "../spec/lamp.yaml")


def test_what_a_revision_does_not_have_is_left_out_and_named(clone: Path) -> None:
    assert find_editions("v0.2.0").left_out == ["spec/blinds.yaml is not in `v0.2.0`"]


def test_the_newest_released_edition_comes_before_the_last_commit(copy: Path) -> None:
    release(copy, "0.9.0", "0.10.0", "0.10.0-rc.2", "0.10.0-rc.10", "0.9.10")
    others = ("stage_lamp-newest", "stage_lamp-1", "stage_lamps-1.0.0", "lamp-1.0.0")
    write_files({f"spec/released/{name}.yaml": LAMPS for name in others}, copy)
    newest_first = ["0.10.0", "0.10.0-rc.10", "0.10.0-rc.2", "0.9.10", "0.9.0"]
    found = [file.stem for file in released(copy / "spec", "stage_lamp")]
    assert found == [f"stage_lamp-{each}" for each in newest_first]
    assert versions() == [BOTH_BLINDS, ("stage_lamp", "0.10.0", "0.5.0")]
    assert versions("stage_lamp-0.9.0") == [("stage_lamp", "0.9.0", "0.5.0")]
    assert versions("stage_lamp-0.9.0", "stage_lamp-0.10.0") == [("stage_lamp", "0.9.0", "0.10.0")]
    assert versions("stage_lamp-0.9.0", "v0.2.0") == [("stage_lamp", "0.9.0", "0.2.0")]
    with pytest.raises(Unusable, match=r"`stage_lamp-0.9.1` is no file and no released") as caught:
        find_editions("stage_lamp-0.9.1")
    assert caught.value.hint.startswith("did you mean `stage_lamp-0.")


@in_turn(
    "words, kept",
    lambda: [
        ((), ["0.2.1", "0.2.0", "0.1.0"]),
        (("lamp",), ["0.2.1", "0.2.0", "0.1.0"]),
        # The last commit says that it is 0.3.0.
        (("HEAD",), ["0.3.0", "0.2.1", "0.2.0", "0.1.0"]),
        (("v0.2.0",), ["0.2.0", "0.1.0"]),
        (("v0.2.0", "lamp"), ["0.2.0", "0.1.0"]),
        # An edition that is named is compared with alone.
        (("stage_lamp-0.2.0",), []),
        (("v0.2.0:spec/lamp.yaml",), []),
        (("v0.2.0", "HEAD"), []),
    ],
)
def test_final_editions_before_the_one_that_is_compared_are_kept(
    copy: Path, words: tuple[str, ...], kept: list[str]
) -> None:
    release(copy, "0.1.0", "0.2.0", "0.2.1", "0.2.2-rc.1", "0.3.0")
    found = find_editions(*words)
    (old,) = (old for old, new in found.pairs if new.spec.protocol.name == "stage_lamp")
    assert [each.edition.version for each in found.kept(old)] == kept


def test_one_edition_can_come_from_the_input(clone: Path, monkeypatch: Patch) -> None:
    def given(data: bytes) -> None:
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(data)))

    given(version(LAMPS, "0.0.1").encode())
    assert versions("-") == [("stage_lamp", "0.0.1", "0.5.0")]
    given(version(LAMPS, "0.0.1").encode())
    assert versions("v0.2.0", "-") == [("stage_lamp", "0.2.0", "0.0.1")]
    given(b"\xff\xfe")
    with pytest.raises(Unusable, match="standard input is not UTF-8 text: byte 0 is 0xFF"):
        find_editions("-")
    given(b"#" * (MAX_BYTES + 1))
    with pytest.raises(Unusable, match=r"standard input has 1.0 MB, and a spec has at most 1 MB"):
        find_editions("-")


NOTHING = "a comparison of nothing"
WRONG = [
    (("v9",), "`v9` is no file and no released edition, and `v9` is no revision", "--tags"),
    (("nope.yaml",), "nope.yaml does not exist", "framegen diff"),
    (("nope.yaml", "HEAD"), "nope.yaml does not exist", "framegen diff"),
    (("HEAD", "v9"), "`v9` is no file", "git fetch"),
    (("v9:spec/lamp.yaml",), "`v9` is no revision of the repository", "git fetch --tags"),
    (("HEAD:nope.yaml",), "nope.yaml is not in `HEAD`", "`HEAD:spec/OLD.yaml`"),
    ((":nope.yaml",), "nope.yaml is not in the index", "from the root"),
    (("HEAD:spec",), "HEAD:spec is not a file", "the spec itself"),
    (("HEAD:",), "`HEAD:` names no file", "HEAD:spec/"),
    (("HEAD:../../x.yaml",), "../../x.yaml is not in `HEAD`", "from the root"),
    (("-x",), "`-x` is no revision", "dash"),
    (("--output=x:spec/lamp.yaml",), "`--output=x` is no revision", "dash"),
    (("docs",), "docs is a folder", "two editions"),
    (("",), "`` names no edition", "two editions"),
    (("a\0b",), "`a\\x00b` names no edition", "two editions"),
    (("HEAD:a\0b",), "`HEAD:a\\x00b` names no edition", "two editions"),
    (("x" * 5000,), "File name too long", "two editions"),
    (("-", "-"), f"{NOTHING}: `-` is named twice", "from the input"),
    (("HEAD", "HEAD"), f"{NOTHING}: `HEAD` is named twice", "two editions"),
    (("lamp", "spec/lamp.yaml"), f"{NOTHING}: both are spec/lamp.yaml", "two editions"),
    (("HEAD:spec/lamp.yaml", "HEAD:spec/lamp.yaml"), NOTHING, "two editions"),
]


@in_turn("words, message, hint", lambda: WRONG)
def test_what_names_no_edition_is_told_with_the_way_out(
    clone: Path, words: tuple[str, ...], message: str, hint: str
) -> None:
    with pytest.raises(Unusable) as caught:
        find_editions(*words)
    assert message in str(caught.value)
    assert hint in caught.value.hint


def test_the_same_file_by_two_ways_is_one_edition_and_two_of_one_text_are_two(copy: Path) -> None:
    (copy / "link.yaml").symlink_to(copy / "spec" / "lamp.yaml")
    with pytest.raises(Unusable, match=rf"{NOTHING}: both are spec/lamp.yaml"):
        find_editions("link.yaml", "lamp")
    (copy / "copy.yaml").write_text(version(LAMPS, "0.5.0"), encoding="utf-8")
    assert versions("copy.yaml") == [("stage_lamp", "0.5.0", "0.5.0")]


def test_without_a_repository_only_files_can_be_named(
    clone: Path, tmp_path: Path, monkeypatch: Patch
) -> None:
    write_files({"project/spec/lamp.yaml": LAMPS}, tmp_path)
    monkeypatch.chdir(tmp_path / "project")
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path))
    for words in ((), ("v1",), ("HEAD:spec/lamp.yaml",), ("HEAD", "lamp")):
        with pytest.raises(Unusable, match="git finds no repository here") as caught:
            find_editions(*words)
        assert caught.value.hint == "name two spec files, or run this in a clone"
    assert versions(str(clone / "spec" / "lamp.yaml"))[0][0] == "stage_lamp"


def test_without_git_revisions_cannot_be_named(clone: Path, monkeypatch: Patch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(Unusable, match="there is no git on this machine") as caught:
        find_editions()
    assert caught.value.hint == "install git, or name two spec files"


def test_the_first_edition_of_a_spec_has_nothing_to_be_compared_with(
    clone: Path, tmp_path: Path, monkeypatch: Patch
) -> None:
    start(tmp_path / "new")
    write_files({"new/spec/lamp.yaml": LAMPS}, tmp_path)
    monkeypatch.chdir(tmp_path / "new")
    first = "spec/lamp.yaml has no earlier edition yet: none is released, and no commit before "
    assert find_editions() == Editions([], [f"{first}this has it"])
    with pytest.raises(Unusable, match="the repository has no commit yet"):
        find_editions("HEAD")
    commit(tmp_path / "new", {"README": "Nothing."})
    git(tmp_path / "new", "rm", "--quiet", "--cached", "spec/lamp.yaml")
    git(tmp_path / "new", "commit", "--quiet", "--amend", "--message", "Without it")
    assert find_editions() == Editions([], [f"{first}this has it"])
    with pytest.raises(Unusable, match=r"spec/lamp\.yaml is not in `HEAD`"):
        find_editions("HEAD")


def test_a_shallow_clone_says_how_it_gets_the_rest(
    clone: Path, tmp_path: Path, monkeypatch: Patch
) -> None:
    shallow = tmp_path / "shallow"
    git(tmp_path, "clone", "--quiet", "--depth", "1", clone.as_uri(), str(shallow))
    monkeypatch.chdir(shallow)
    with pytest.raises(Unusable, match=r"`v0.2.0` is no revision of this clone") as caught:
        find_editions("v0.2.0")
    assert "git fetch --unshallow --tags" in caught.value.hint
    assert "fetch-depth: 0" in caught.value.hint


def test_a_spec_that_rules_dislike_is_an_edition_all_the_same() -> None:
    text = LAMPS.replace("length: ", "length: 1 + ", 1)
    source = Source("lamp.yaml", text)
    assert compile_spec(source).findings
    compiled = compile_leniently(source)
    assert (compiled.findings, compiled.tolerated) == ([], tuple(compile_spec(source).findings))
    assert compiled.model.messages.keys() == compile_spec(Source("x", LAMPS)).model.messages.keys()


@in_turn(
    "text, said",
    lambda: [
        ("framegen: 99\n", "edition 99 of the language"),
        ("framegen: 2\n", "finding"),
        ("[]", "holds a list"),
        ("a: b: c", "the file is not YAML"),
    ],
)
def test_what_has_no_model_is_no_edition(text: str, said: str) -> None:
    with pytest.raises(Unusable) as caught:
        edition_of(Source("lamp.yaml", text))
    assert said in str(caught.value)
    assert str(caught.value).startswith("lamp.yaml")


def test_where_an_edition_is_from_does_not_show_in_what_is_made_of_it() -> None:
    for file in (BUSSERVO, DEMO):
        text = file.read_text(encoding="utf-8")
        one, other = (edition_of(Source(name, text)) for name in ("a/b.yaml", "v1:spec/c.yaml"))
        assert one.compiled.source.path == other.compiled.source.path
        assert one.label != other.label


# ------------------------------------------------------------------ renamed, and gone


def named(name: str, number: str) -> str:
    return version(LAMPS, number).replace("name: stage_lamp", f"name: {name}")


def written(copy: Path, *specs: tuple[str, str]) -> None:
    """Have these specs lie there, and no others."""
    for file in (copy / "spec").glob("*.yaml"):
        file.unlink()
    write_files({f"spec/{name}.yaml": text for name, text in specs}, copy)


WEATHER = (ROOT / "tests" / "specs" / "weather.yaml").read_text(encoding="utf-8")
NO_LAMP = "spec/lamp.yaml is gone: everything of stage_lamp breaks"
NO_BLINDS = "spec/blinds.yaml is gone: everything of blinds breaks"
BEACON = ("beacon", "0.3.0", "0.6.0")
LANTERN = lamp("0.3.0", "0.6.0")
MOVED = [
    ([("lantern", named("stage_lamp", "0.6.0")), ("blinds", BLINDS)], [BOTH_BLINDS, LANTERN], []),
    # Two files changed places.
    ([("lamp", BLINDS), ("blinds", named("stage_lamp", "0.6.0"))], [LANTERN, BOTH_BLINDS], []),
    # The protocol has another name, and its file, too.
    ([("beacon", named("beacon", "0.6.0")), ("blinds", BLINDS)], [BEACON, BOTH_BLINDS], []),
    ([("lamp", named("beacon", "0.6.0")), ("blinds", BLINDS)], [BOTH_BLINDS, BEACON], []),
    ([("blinds", BLINDS)], [BOTH_BLINDS], [NO_LAMP]),
    # What came has nothing to do with what went.
    ([("lamp", LAMPS), ("weather", WEATHER)], [lamp("0.3.0", "0.4.0")], [NO_BLINDS]),
    # Two are gone: either may be the one that has another name.
    ([("beacon", named("beacon", "0.6.0"))], [], [NO_BLINDS, NO_LAMP]),
    ([], [], [NO_BLINDS, NO_LAMP]),
]


@in_turn("words", lambda: [[], ["HEAD"]])
@in_turn("specs, pairs, gone", lambda: MOVED)
def test_a_spec_is_followed_to_its_new_name_or_is_gone(
    copy: Path, words: list[str], specs: list[tuple[str, str]], pairs: Found, gone: list[str]
) -> None:
    written(copy, *specs)
    assert versions(*words) == pairs
    assert [str(each) for each in find_editions(*words).gone] == gone


def test_a_released_protocol_without_a_spec_is_gone(copy: Path) -> None:
    release(copy, "0.3.0", "0.2.0")
    others = {"other-1.0.0": version(LAMPS, "1.0.0"), "notes": version(LAMPS, "notes")}
    write_files({f"spec/released/{name}.yaml": text for name, text in others.items()}, copy)
    written(copy, ("blinds", BLINDS))
    git(copy, "add", "--all")
    git(copy, "commit", "--quiet", "--message", "Without the lamp")
    (gone,) = find_editions().gone
    assert str(gone) == NO_LAMP.replace("lamp.yaml", "stage_lamp.yaml")
    assert (gone.edition, gone.released) == ("spec/released/stage_lamp-0.3.0.yaml", True)
    assert find_editions("HEAD").gone == []
    # Its library has another name now.
    written(copy, ("blinds", BLINDS), ("beacon", named("beacon", "0.6.0")))
    assert versions() == [BEACON, BOTH_BLINDS]
    assert find_editions().gone == []
    written(copy)
    assert len(find_editions().gone) == 2


def test_without_a_project_the_error_is_that(
    alone: None, tmp_path: Path, monkeypatch: Patch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    with pytest.raises(Unusable, match="no spec is named"):
        find_editions()
