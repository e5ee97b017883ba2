"""A change of the spec: everything that has to be written by hand is named, and nothing else."""

import json
import shutil
from pathlib import Path
from typing import NamedTuple, TypeAlias

import pytest
from framegen.cli import main
from framegen.witnesses import DECLARATION, read_witnesses

from tests.commands import called
from tests.factories import BUSSERVO, DEMO, NEW_MESSAGE, ROOT, data_of
from tests.in_turn import in_turn
from tests.mutations.spec_edits import change

# Kind, file and subject.
Missing: TypeAlias = tuple[str, str, str]

CASES, ORACLE = "tests/cases.py", "tests/oracle.py"
CONTRACT = "tests/contract/test_client_contract.py"
POINTS = "Lists.fields.points"

BLOW_CASE = """\
    Case(
        HornBlow(times=2, pause_ms=300), "55 55 05 C9 02 2C 01", HOST, "1.8 example 1"
    ),
"""
BLOW_LAYOUT = '        "HornBlow": _frame(201, "times" / Byte, "pause_ms" / Int16ul),\n'
BLOW_CONTRACT = '    "HornBlow": ("horn_blow", ("times", "pause_ms"), None, "", (), ()),\n'
FIELD = "      source: {type: u8, about: Which terminals.}\n"
NAMED = "        values: {empty: {value: 7500, about: Charge it.}}\n"


class Project(NamedTuple):
    """A copy of a spec, of the files written by hand beside it, and of their list."""

    folder: Path
    spec: Path

    def write(self, file: str, text: str) -> None:
        (self.folder / file).write_text(text, encoding="utf-8")

    def declare(self, of: str, text: str, written: str = "") -> None:
        """Declare one witness for the protocol, a file in which this is written."""
        declared = LAYOUT.replace("{of}", of).replace("{text}", text)
        self.write(DECLARATION, declared.replace("busservo", self.spec.stem))
        self.write("made_up.txt", written)

    def missing(self) -> list[Missing]:
        """Return the findings of the command."""
        status, printed, _ = called(main, "missing", "--json", str(self.spec))
        found = [json.loads(line) for line in printed.splitlines()]
        assert status == bool(found)
        return [(each["kind"], each["in"], each["path"]) for each in found]

    def refusal(self) -> str:
        """Return what the command says where it can find nothing."""
        status, printed, errors = called(main, "missing", str(self.spec))
        assert (status, printed) == (2, "")
        return errors.removeprefix("framegen: error: ")


@pytest.fixture
def project(tmp_path: Path) -> Project:
    witnesses = read_witnesses(ROOT, "busservo") or []
    for path in ("spec/busservo.yaml", DECLARATION, *(each.file for each in witnesses)):
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / path, tmp_path / path)
    return Project(tmp_path, tmp_path / "spec" / "busservo.yaml")


def test_nothing_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    status, printed, _ = called(main, "missing")
    said = f"what a change of the spec needs is to be written first:\n\n{printed}"
    assert status == 0, f"{said}(in a run of all tests, no other test was run)"


# The changes of the spec, what is missing after them, and what has to be written.
CHANGES: dict[str, tuple[list[tuple[str, str]], list[Missing], dict[str, tuple[str, str]]]] = {
    "a command": (
        [("  ServoUnload:\n", f"{NEW_MESSAGE}  ServoUnload:\n")],
        [
            ("case", CASES, "messages.HornBlow"),
            ("layout", ORACLE, "messages.HornBlow"),
            ("contract", CONTRACT, "messages.HornBlow"),
        ],
        {
            CASES: ("CASES = (\n", f"CASES = (\n{BLOW_CASE}"),
            ORACLE: ('        "ServoUnload":', f'{BLOW_LAYOUT}        "ServoUnload":'),
            CONTRACT: ('    "ServoUnload":', f'{BLOW_CONTRACT}    "ServoUnload":'),
        },
    ),
    "a field": (
        [
            (
                "section 1.5\n    length: 4\n    fields:\n",
                f"section 1.5\n    length: 5\n    fields:\n{FIELD}",
            ),
            ("hex: 55 55 04 0F 4C 1D", "hex: 55 55 05 0F 00 4C 1D"),
            ("hex: 55 55 04 0F C9 1E", "hex: 55 55 05 0F 00 C9 1E"),
            ("{voltage_mv: 7500}", "{source: 0, voltage_mv: 7500}"),
            ("{voltage_mv: 7881}", "{source: 0, voltage_mv: 7881}"),
        ],
        [("keyword", CASES, "messages.BatteryVoltage.fields.source")],
        {CASES: ("BatteryVoltage(voltage_mv=7500)", "BatteryVoltage(source=0, voltage_mv=7500)")},
    ),
    "a named value": (
        [("        scale: 0.001 V\n", f"        scale: 0.001 V\n{NAMED}")],
        [("constant", CASES, "messages.BatteryVoltage.fields.voltage_mv.values.empty")],
        {CASES: ("voltage_mv=7500", "voltage_mv=BatteryVoltage.VOLTAGE_MV_EMPTY")},
    ),
}


@pytest.mark.parametrize("what", CHANGES)
def test_what_a_change_needs_is_named_until_it_is_there(what: str, project: Project) -> None:
    changes, needed, written = CHANGES[what]
    assert project.missing() == []
    change(project.spec, *changes)
    assert project.missing() == needed
    for file, text in written.items():
        change(project.folder / file, text)
        needed = [each for each in needed if each[1] != file]
        assert project.missing() == needed
    assert needed == []


def test_the_report_says_where_to_write_what_and_why(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    change(project.spec, *CHANGES["a command"][0])
    monkeypatch.chdir(project.folder)
    status, printed, errors = called(main, "missing")
    first = printed.split("\n\n")[0].splitlines()
    line = project.spec.read_text(encoding="utf-8").splitlines().index("  HornBlow:") + 1
    assert first[:3] == [
        "tests/cases.py: HornBlow has no case",
        f"    = see: spec/busservo.yaml:{line}:3",
        '    = write: Case(HornBlow(times=..., pause_ms=...), "55 55 ...", HOST, "section"),',
    ]
    assert first[3].startswith("    = why: ")
    messages = len(data_of(BUSSERVO)["messages"]) + 1
    assert errors.startswith(f"spec/busservo.yaml: {messages} messages, ")
    assert (status, errors.endswith(" files: 3 missing\n")) == (1, True)


LAYOUT = """\
busservo:
  case:
    of: {of}
    file: made_up.txt
    text: '{text}'
    write: a case
    why: it is tried
"""


@in_turn(
    "of, text, written, found",
    lambda: [
        ("messages", "Case({message}(", "Case(ServoMove(1))", True),
        ("messages", "Case({message}(", "Case (\n  ServoMove\n(1))", True),
        ("messages", "Case({message}(", "BadCase(ServoMove(1))", False),
        ("messages", "Case({message}(", "Case(ServoMoves(1))", False),
        ("messages", "Case({message}(", "Case(MyServoMove(1))", False),
        ("messages", "case {message}", "case ServoMove", True),
        ("messages", "case {message}", "case\nServoMove", True),
        ("messages", "case {message}", "caseServoMove", False),
        ("messages", "[{MESSAGE}] {SENDER}", "[SERVO_MOVE] HOST", True),
        ("messages", "[{MESSAGE}] {SENDER}", "[SERVOMOVE] HOST", False),
        ("messages", ".{message}.", "xServoMovex", False),
        ("messages", "x{message}: {fields}", "xServoMove: time_ms=..., targets=...", True),
        ("requests", "Case({message}, {method})", "Case(ServoMove, move_servos)", True),
        ("fields", "Case({message}(...{field}=", "Case(ServoMove(f(1, (2,)), time_ms=1))", True),
        ("fields", "Case({message}(...{field}=", "Case(ServoMove(1)), Case(X(time_ms=1))", False),
        ("fields", "Case({message}(...{field}=", "Case(ServoMove(real_time_ms=1))", False),
        ("values", "Case({message}...{FIELD}_{VALUE}", "Case(ServoMove, TIME_MS_NEVER)", True),
        ("values", "Case({message}...{FIELD}_{VALUE}", "Case(ServoMove, TIME_MS_NEVER_1)", False),
    ],
)
def test_a_pattern_matches_the_name_or_value_it_is_made_of(
    of: str, text: str, written: str, found: bool, named: Project
) -> None:
    named.declare(of, text, written)
    field = "ServoMove.fields.time_ms"
    name = {"fields": field, "values": f"{field}.values.never"}.get(of, "ServoMove")
    sought = ("case", "made_up.txt", f"messages.{name}")
    assert (sought not in named.missing()) is found


@pytest.fixture
def named(project: Project) -> Project:
    """Return a project in whose spec a value of ServoMove has a name."""
    about = "        about: How long the motion takes.\n"
    value = f"{about}        values: {{never: {{value: 800, about: x}}}}\n"
    change(project.spec, (about, value))
    return project


@in_turn(
    "of, text, written, gone",
    lambda: [
        ("fields", "x {message}.{field}", "x Flags.error", "messages.Flags.fields.error"),
        ("bits", "BIT_{FIELD}_{BIT}", "BIT_ERROR_HEAT", "messages.Flags.fields.error.bits.heat"),
        ("bits", "BIT {field} {bit}", "BIT flags far", f"messages.{POINTS}.fields.flags.bits.far"),
        ("addresses", "AT_{ADDRESS}_{VALUE}", "AT_STATION_ALL", "frames.ask.station.values.all"),
    ],
)
def test_bits_and_addresses_can_have_witnesses_too(
    of: str, text: str, written: str, gone: str, everything: Project
) -> None:
    everything.declare(of, text)
    before = everything.missing()
    everything.write("made_up.txt", written)
    after = {path for _, _, path in everything.missing()}
    assert [path for _, _, path in before if path not in after] == [gone]


@pytest.fixture
def everything(project: Project) -> Project:
    """Return a project with a spec of all kinds of fields."""
    spec = DEMO.with_name("everything.yaml")
    return project._replace(spec=Path(shutil.copy(spec, project.folder / "spec")))


def test_what_every_frame_has_is_no_field(everything: Project) -> None:
    everything.declare("fields", "x {field}")
    printed = called(main, "missing", str(everything.spec)).out
    assert "Numbers.a_u8 has no case" in printed
    assert "station" not in printed
    assert "sequence" not in printed


@pytest.mark.parametrize("declared", [None, "kiln: {}\n"])
def test_without_declarations_nothing_is_complete(declared: str | None, project: Project) -> None:
    (project.folder / DECLARATION).unlink()
    if declared:
        project.write(DECLARATION, declared)
    messages = len(data_of(BUSSERVO)["messages"])
    assert project.refusal() == (
        f"{project.spec.as_posix()} has {messages} messages, and no witness is declared for it: "
        "nothing was looked for\n  hint: tests/witnesses.yaml declares them, by the name of the "
        "protocol: `busservo: {}` for none\n"
    )


def test_a_project_may_have_no_witness(project: Project) -> None:
    project.write(DECLARATION, "busservo: {}\n")
    said = f"{project.spec.as_posix()}: nothing looked up in 0 files: nothing is missing\n"
    assert called(main, "missing", str(project.spec)) == (0, "", said)


@in_turn(
    "old, new, said",
    lambda: [
        ("messages", "mesages", "3:5: busservo.case.of: nothing of a spec is `mesages`"),
        ("    of: messages\n", "", "2:3: busservo.case.of: is missing"),
        ("    why:", "    because:", "7:5: busservo.case.because: no such key"),
        ("it is tried", "12", "7:5: busservo.case.why: is no text"),
        ("{message}", "{massage}", "5:5: busservo.case.text: nothing is put for `{massage}`"),
        ("a case", "a case of {field}", "6:5: busservo.case.write: nothing is put for `{field}`"),
        ("Case({message}(", "Case(", "5:5: busservo.case.text: this is no pattern"),
        ("Case({message}(", "{message}(", "5:5: busservo.case.text: this is no pattern"),
        ("  case:", "  case: [1]\n  other:", "2:3: busservo.case: no mapping"),
        ("  why", "\twhy", "tests/witnesses.yaml is no mapping of protocols to witnesses\n"),
        ("  case:", "  case: &a", "tests/witnesses.yaml is no mapping of protocols to witnesses\n"),
    ],
)
def test_an_invalid_declaration_is_reported_with_its_place(
    old: str, new: str, said: str, project: Project
) -> None:
    project.declare("messages", "Case({message}(")
    change(project.folder / DECLARATION, (old, new))
    place = "" if said.startswith("tests") else "tests/witnesses.yaml:"
    assert project.refusal().startswith(place + said)


@in_turn(
    "data, why", lambda: [(None, "No such file or directory"), (b"\xff", "it is not UTF-8 text")]
)
def test_a_file_that_cannot_be_read_is_told(data: bytes | None, why: str, project: Project) -> None:
    project.declare("messages", "Case({message}(")
    (project.folder / "made_up.txt").unlink()
    if data:
        (project.folder / "made_up.txt").write_bytes(data)
    said = f"made_up.txt, which tests/witnesses.yaml names, cannot be read: {why}\n"
    assert project.refusal().startswith(said)
