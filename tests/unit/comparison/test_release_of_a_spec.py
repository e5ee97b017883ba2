"""`framegen release`: the version that is due, what the spec then says, and the edition kept."""

import io
import json
from contextlib import redirect_stdout
from functools import partial
from pathlib import Path
from shutil import copytree
from typing import Any, TypeAlias

import pytest
from framegen.cli import main
from framegen.comparison import comparison
from framegen.comparison.comparison import Comparison
from framegen.comparison.listing import working_edition
from framegen.comparison.programs import program_effects
from framegen.comparison.report.verdict import BREAKS, UNCERTAIN
from framegen.writing import disk

from tests import bad_specs
from tests.factories import data_of, write_files
from tests.mutations.spec_edits import change as change_file
from tests.mutations.spec_edits import edited

Capture: TypeAlias = pytest.CaptureFixture[str]

SPEC = Path("spec/lamps.yaml")
change = partial(change_file, SPEC)
FIRST = Path("spec/released/lamps-1.0.0.yaml")
FADE = """\
LampFade:
  id: 9
  direction: host -> lamp
  summary: Fade a lamp.
  cite: manual, section 3
  length: 2
  fields:
    lamp_id: {type: u8, about: The lamp.}
  examples:
    - {title: Lamp 1, hex: AA 55 02 09 01, values: {lamp_id: 1}, cite: manual}
"""
BLINK = FADE.replace("Fade", "Blink").replace("9", "10", 1).replace("02 09 01", "02 0A 01")
NEW = {"after": "LampRead:", "add": BLINK}
LAMPS = edited(f"# Ours.\n{bad_specs.base('lamps')}", {"after": "LampRead:", "add": FADE})
WORDS = {"replace": "summary: Lamps on a line.", "with": "summary: Lamps on one line."}
WITHOUT_FADE = {"remove": "LampFade:"}
NOBODY = ("--accept", "Nobody has it.")
RAISED = {"under": "protocol", "replace": '"1.0.0"', "with": "2.0.0  # soon"}


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a project of lamps whose first edition is released."""
    folder = tmp_path_factory.mktemp("first")
    write_files({SPEC.as_posix(): LAMPS}, folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        printed = io.StringIO()
        with redirect_stdout(printed):
            assert main(["release"]) == 0
    assert printed.getvalue() == f"wrote {SPEC.as_posix()}\nwrote {FIRST.as_posix()}\n"
    return folder


@pytest.fixture(autouse=True)
def _project(first: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A copy of that project, in which the test is."""
    copytree(first, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    # What becomes of programs takes the longest, and matters to few of these tests.
    monkeypatch.setattr(comparison, "program_effects", lambda _pair: [])


@pytest.fixture
def programs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(comparison, "program_effects", program_effects)


def history(*entries: str) -> dict[str, Any]:
    return {"before": '- version: "1.0.0"', "add": "\n".join(entries)}


def files() -> dict[str, bytes]:
    return {path.as_posix(): path.read_bytes() for path in Path().rglob("*") if path.is_file()}


def test_the_first_release_keeps_the_version_and_says_so_in_the_history() -> None:
    assert SPEC.read_bytes() == FIRST.read_bytes()
    assert data_of(SPEC)["history"] == [{"version": "1.0.0", "changes": ["The first release."]}]
    assert SPEC.read_text(encoding="utf-8").startswith(LAMPS)


@pytest.mark.parametrize(
    ("edits", "version"),
    [([WORDS], "1.0.1"), ([NEW], "1.1.0"), ([NEW, WORDS], "1.1.0"), ([WITHOUT_FADE], "2.0.0")],
    ids=["words", "a message", "both", "without a message"],
)
@pytest.mark.usefixtures("programs")
def test_the_version_is_the_one_that_is_due(edits: list[dict[str, Any]], version: str) -> None:
    change(*edits)
    before = data_of(SPEC)
    assert main(["release", "lamps", *NOBODY]) == 0
    after = data_of(SPEC)
    assert Path(f"spec/released/lamps-{version}.yaml").read_bytes() == SPEC.read_bytes()
    assert after["protocol"] == {**before["protocol"], "version": version}
    entry, *others = after["history"]
    assert others == before["history"]
    assert entry["version"] == version
    assert entry["changes"]
    assert ("breaks" in entry) == (version == "2.0.0")
    kept = before.keys() - {"protocol", "history"}
    assert {key: after[key] for key in kept} == {key: before[key] for key in kept}
    assert main(["check"]) == 0


@pytest.mark.usefixtures("programs")
def test_what_was_removed_is_reserved_and_what_breaks_is_accepted() -> None:
    old = working_edition(SPEC)
    change(WITHOUT_FADE)
    assert main(["release", "--accept", " It: was never sold. "]) == 0
    data = data_of(SPEC)
    why = "Up to 1.0.0 it was LampFade: It: was never sold."
    fade = {"id": 9, "direction": "host -> lamp", "name": "LampFade", "why": why}
    assert data["reserved"] == [fade]
    breaks = data["history"][0]["breaks"]
    assert breaks["messages.LampFade"] == "It: was never sold."
    effects = Comparison(old, working_edition(SPEC)).effects
    assert [each for each in effects if each.breaks and not each.accepted] == []
    # From then on, an author does not give them to another message unawares.
    change(NEW, {"replace": "id: 10", "with": "id: 9"})
    assert main(["check"]) == 1


@pytest.mark.parametrize(
    "reserved",
    ["[{id: 9, name: LampFade, why: It.}]", "[{id: 9, why: It.}, {name: LampFade, why: It.}]"],
)
def test_what_is_reserved_is_not_reserved_again(reserved: str) -> None:
    change(WITHOUT_FADE, {"before": "history:", "add": f"reserved: {reserved}"})
    before = data_of(SPEC)["reserved"]
    assert main(["release", *NOBODY]) == 0
    assert data_of(SPEC)["reserved"] == before


def test_an_id_that_has_another_message_is_not_reserved() -> None:
    taken = BLINK.replace("id: 10", "id: 9").replace("02 0A 01", "02 09 01")
    change({"instead": "LampFade:", "add": taken})
    assert main(["release", *NOBODY]) == 0
    assert data_of(SPEC)["reserved"] == [
        {"name": "LampFade", "why": "Up to 1.0.0 it was LampFade: Nobody has it."}
    ]


# ------------------------------------------------------------------ what the author wrote before


def test_what_the_author_said_of_the_new_version_stays() -> None:
    told = ("  changes: [Lamps are read alone.]", "  breaks:")
    why = "    messages.LampFade: It was never sold  # at all"
    change(WITHOUT_FADE, RAISED, history("- version: 2.0.0", *told, why))
    before = data_of(SPEC)["history"]
    assert main(["release"]) == 0
    assert data_of(SPEC)["history"] == before
    [reserved] = data_of(SPEC)["reserved"]
    assert reserved["why"] == "Up to 1.0.0 it was LampFade: It was never sold."
    text = SPEC.read_text(encoding="utf-8")
    assert "version: 2.0.0  # soon\n" in text
    assert "# at all\n" in text


def test_a_new_version_without_changes_is_completed() -> None:
    change(RAISED, history("- {version: 2.0.0, changes: []}"), WORDS)
    assert main(["release"]) == 0
    first, *_ = data_of(SPEC)["history"]
    assert first["version"] == "2.0.0"
    assert first["changes"]


@pytest.mark.parametrize(
    "entry",
    [
        ["- {version: 2.0.0, changes: [It.]}"],
        ["- version: 2.0.0  # soon", "  changes: [It.]"],
        ["- {version: 2.0.0, breaks: {link.baud: Faster.}, changes: [It.]}"],
        ["- changes: [It.]", "  breaks:", "    link.baud: Faster.", "  version: 2.0.0"],
    ],
)
def test_a_reason_is_added_to_the_new_version(entry: list[str]) -> None:
    change(WITHOUT_FADE, RAISED, history(*entry))
    before = data_of(SPEC)["history"][0].get("breaks", {})
    assert main(["release", *NOBODY]) == 0
    first, *_ = data_of(SPEC)["history"]
    assert first["changes"] == ["It."]
    assert first["breaks"].items() > before.items()
    assert first["breaks"]["messages.LampFade"] == "Nobody has it."


def test_another_version_takes_along_what_names_the_one_before() -> None:
    planned = {"under": "protocol", "replace": '"1.0.0"', "with": '"1.1.0"'}
    since = {"after": "summary: Blink a lamp.", "add": 'since: "1.1.0"'}
    change(planned, history("- {version: 1.1.0, changes: [LampBlink is new.]}"), NEW, since)
    assert main(["release", "--version", "1.2.0"]) == 0
    data = data_of(SPEC)
    assert data["protocol"]["version"] == data["messages"]["LampBlink"]["since"] == "1.2.0"
    assert [each["version"] for each in data["history"]] == ["1.2.0", "1.0.0"]


def test_a_candidate_promises_nothing() -> None:
    change(NEW)
    assert main(["release", "--version", "1.1.0-rc.1"]) == 0
    change({"remove": "LampRead:"}, {"remove": "LampState:"})
    assert main(["release", *NOBODY, "--version", "2.0.0-rc.1"]) == 0
    assert main(["release"]) == 0
    versions = [each["version"] for each in data_of(SPEC)["history"]]
    assert versions == ["2.0.0", "2.0.0-rc.1", "1.1.0-rc.1", "1.0.0"]


# ------------------------------------------------------------------ editions before the newest

GLOW = BLINK.replace("Blink", "Glow").replace("id: 10", "id: 9").replace("02 0A 01", "02 09 01")
SIGNED = {"under": "LampGlow", "replace": "type: u8", "with": "type: i8"}
MISREAD = "messages.LampGlow: old host of 1.0.0 -> new lamp: LampFade is read as LampGlow\n"


@pytest.fixture
def freed(capsys: Capture) -> None:
    """Remove a message, and release that; then drop what was reserved for it, and release that."""
    change(WITHOUT_FADE)
    assert main(["release", *NOBODY]) == 0
    change({"remove": "reserved:"})
    assert (main(["check"]), main(["diff"]), main(["release"])) == (0, UNCERTAIN, 2)
    # No name changed.
    assert "was: OldName" not in capsys.readouterr().err
    assert main(["release", *NOBODY]) == 0
    assert data_of(SPEC)["protocol"]["version"] == "3.0.0"


@pytest.mark.usefixtures("freed")
def test_an_id_of_an_edition_before_the_newest_is_not_used_again_unawares(capsys: Capture) -> None:
    change({"after": "LampRead:", "add": GLOW}, SIGNED)
    capsys.readouterr()
    assert (main(["check"]), main(["diff"]), main(["release"])) == (0, BREAKS, 2)
    said = capsys.readouterr()
    _, _, read = MISREAD.partition(": ")
    assert f"  breaks: wire, {read}" in said.out
    assert MISREAD in said.err
    # Who names an edition compares with that alone.
    assert (main(["diff", "lamps-3.0.0"]), main(["diff", "lamps-1.0.0"])) == (0, BREAKS)
    assert main(["release", "--accept", "Lamps of 1.0.0 were recalled."]) == 0
    breaks = data_of(SPEC)["history"][0]["breaks"]
    assert breaks == {"messages.LampGlow": "Lamps of 1.0.0 were recalled."}
    # What was released so is not asked for again.
    change(WORDS)
    assert (main(["diff"]), main(["release"])) == (0, 0)
    assert data_of(SPEC)["protocol"]["version"] == "4.0.1"


@pytest.mark.usefixtures("freed")
def test_a_message_that_is_back_under_another_name_says_so() -> None:
    change({"after": "LampRead:", "add": GLOW})
    assert (main(["diff"]), main(["release"])) == (UNCERTAIN, 2)
    change({"under": "LampGlow", "after": "id:", "add": "was: LampFade"})
    assert (main(["diff"]), main(["release"])) == (0, 0)
    assert data_of(SPEC)["protocol"]["version"] == "3.1.0"


@pytest.mark.usefixtures("freed")
def test_a_kept_edition_that_cannot_be_read_is_named_and_stops_nothing(capsys: Capture) -> None:
    FIRST.write_text("framegen: 99\n", encoding="utf-8")
    change(NEW)
    capsys.readouterr()
    assert (main(["diff"]), main(["release"])) == (0, 0)
    assert capsys.readouterr().err.count(f"not compared: {FIRST.as_posix()}: ") == 2


# ------------------------------------------------------------------ what is refused

HIGHER = "  hint: use --version 1.1.0, or a higher one\n"
TOO_LOW = "something is new or deprecated since 1.0.0, so the version 1.0.1 is too low:"
REFUSED = [
    ([], [], "nothing changed since 1.0.0\n  hint: there is nothing to release\n"),
    ([NEW], ["--version", "1"], '`1` is no semantic version\n  hint: write "1.0.0"\n'),
    ([NEW], ["--version", "1.0.0"], "1.0.0 is released already\n  hint: take a higher version\n"),
    ([NEW], ["--version", "1.0.1"], f"{TOO_LOW} 1.1.0 is due\n{HIGHER}"),
    ([NEW], ["--version", "0.9.0"], f"the version went back from 1.0.0 to 0.9.0\n{HIGHER}"),
    ([WITHOUT_FADE], [], "nothing says why this breaks:\n  messages.LampFade: "),
    ([WITHOUT_FADE], ["--accept", " "], "the reason is empty:\n  messages.LampFade: "),
    ([{"replace": "history:", "with": '"history": &here'}, WORDS], [], ""),
]


@pytest.mark.parametrize(("edits", "words", "why"), REFUSED)
def test_what_can_be_no_release_is_refused_and_nothing_is_written(
    edits: list[dict[str, Any]], words: list[str], why: str, capsys: Capture
) -> None:
    change(*edits)
    before = files()
    code = main(["release", *words])
    said = capsys.readouterr()
    assert code == (2 if why else 1)
    assert said.err.startswith(f"framegen: error: {why}" if why else "1 finding in spec/lamps.yaml")
    assert files() == before


def test_where_a_name_may_have_changed_the_way_to_say_so_is_told(capsys: Capture) -> None:
    change({"instead": "LampFade:", "add": BLINK.replace("10", "9", 1).replace("0A", "09", 1)})
    assert main(["release"]) == 2
    assert "what only has another name says so by `was: OldName`\n" in capsys.readouterr().err
    change({"under": "LampBlink", "after": "id:", "add": "was: LampFade"})
    main(["release"])
    assert "was: OldName" not in capsys.readouterr().err


def test_a_spec_without_lines_is_to_be_edited_by_hand(capsys: Capture) -> None:
    change(NEW)
    data = data_of(SPEC)
    del data["history"]
    SPEC.write_text(json.dumps(data), encoding="utf-8")
    before = files()
    assert main(["release"]) == 2
    said = capsys.readouterr().err
    assert "spec/lamps.yaml is laid out in a way that cannot be edited here" in said
    assert '- version: "1.1.0"\n  changes:\n    - ' in said
    assert files() == before


def test_a_dry_run_shows_what_would_be_written(capsys: Capture) -> None:
    change(NEW)
    before = files()
    assert main(["release", "--dry-run"]) == 0
    shown = capsys.readouterr()
    assert files() == before
    assert "--- a/spec/lamps.yaml\n+++ b/spec/lamps.yaml\n" in shown.out
    assert '-  version: "1.0.0"\n+  version: "1.1.0"\n' in shown.out
    assert shown.err.startswith("spec/released/lamps-1.1.0.yaml would be a copy of that")


# ------------------------------------------------------------------ the disk


@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"], ids=["plain", "marked"])
@pytest.mark.parametrize("end", [b"\n", b"\r\n"], ids=["lf", "crlf"])
def test_line_ends_and_a_mark_stay_as_they_are(mark: bytes, end: bytes) -> None:
    change(NEW)
    text = SPEC.read_bytes()
    SPEC.write_bytes(mark + text.replace(b"\n", end))
    SPEC.chmod(0o640)
    assert main(["release"]) == 0
    data = SPEC.read_bytes()
    assert data.startswith(mark + b"# Ours.")
    assert data.count(b"\n") == data.count(end)
    assert Path("spec/released/lamps-1.1.0.yaml").read_bytes() == data
    assert SPEC.stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("moves", [0, 1])
def test_a_run_that_the_disk_stops_is_finished_by_the_next(
    moves: int, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    change(NEW)
    before = files()
    left = iter(range(moves))
    move = disk.move

    def fail(old: Path, new: Path) -> None:
        if next(left, None) is None:
            raise OSError(28, "No space left on device", str(new))
        move(old, new)

    with monkeypatch.context() as patch:
        patch.setattr(disk, "move", fail)
        assert main(["release"]) == 2
    assert "No space left on device" in capsys.readouterr().err
    changed = {path for path, data in files().items() if before.get(path) != data}
    assert changed == ({SPEC.as_posix()} if moves else set())
    assert main(["release"]) == 0
    assert Path("spec/released/lamps-1.1.0.yaml").read_bytes() == SPEC.read_bytes()
    assert [each["version"] for each in data_of(SPEC)["history"]] == ["1.1.0", "1.0.0"]
    assert {path.name for path in Path().iterdir()} == {"spec"}
