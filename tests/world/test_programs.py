"""What is told of programs is what becomes of one, after every mutation, each of one spec a day.

--seed chooses the specs, and where in them something is changed.
"""

import sys
from pathlib import Path

import pytest
from framegen.comparison.pair import Pair
from hypothesis import given

from tests.contract.comparison.program_of_all import fails, namespace, program, run
from tests.contract.comparison.program_verdicts import files_of, verdict_on
from tests.contract.comparison.test_programs import assert_seen
from tests.factories import library, write_files
from tests.few_each import few_each
from tests.mutations.edits import EDITS, of_the_day, pair_of
from tests.mutations.mutations import MUTATIONS, Editions, after, editions
from tests.programs import ran

SPECS = ("busservo", "lamp", "blinds", "everything", "modbus", "roboclaw", "dynamixel1")
# What a type checker is asked about takes it seconds.
CHECKED = ("words: summary", "a message added", "u16 became u32", "a field renamed, said")


def assert_told(made: Editions) -> None:
    pair = Pair(made.old, made.new)
    verdict = verdict_on(pair)
    assert verdict is not None
    assert_seen(verdict, pair)


@pytest.mark.parametrize("mutation", MUTATIONS)
def test_a_program_sees_what_is_told(mutation: str, pytestconfig: pytest.Config) -> None:
    seed = pytestconfig.getoption("seed")
    first = (seed + [*MUTATIONS].index(mutation)) % len(SPECS)
    tried = (after(spec, [mutation], seed) for spec in (*SPECS[first:], *SPECS[:first]))
    made = next((each for each in tried if each is not None), None)
    if made is None:
        pytest.skip("it fits none of these specs")
    assert_told(made)
    assert_told(made.turned)


@few_each
@given(editions("busservo"))
def test_a_program_sees_what_is_told_of_several_changes(made: Editions) -> None:
    assert_told(made)


@pytest.mark.parametrize("name", EDITS)
def test_a_program_sees_what_is_told_of_an_edit(name: str, pytestconfig: pytest.Config) -> None:
    verdict = verdict_on(pair_of(*of_the_day(name, pytestconfig.getoption("seed"))))
    # One fact was changed, and the rest of a spec may contradict it.
    if verdict is not None and not verdict.breaking:
        assert verdict.differing == []


@pytest.mark.parametrize("mutation", CHECKED)
def test_a_program_has_the_right_types_where_nothing_is_told(mutation: str, tmp_path: Path) -> None:
    made = after("busservo", [mutation])
    assert made is not None
    verdict = verdict_on(Pair(made.old, made.new))
    assert verdict is not None
    assert complaints(made, tmp_path, "old") == []
    assert (complaints(made, tmp_path, "new") == []) is (verdict.breaking == [])


def complaints(made: Editions, folder: Path, which: str) -> list[str]:
    """Return what a type checker says of a program for the old library beside a library."""
    files, old = files_of(made.new if which == "new" else made.old), files_of(made.old)
    assert files is not None
    assert old is not None
    with library(old) as imported:
        names = namespace(imported)
        statements = [
            each
            for each in dict.fromkeys(program(imported))
            # The helpers are not typed.
            if not each.startswith(("isinstance(asked", "asked", "handled", "matched", "repr"))
            and not each.startswith(("accepted", "callable", "isinstance", "decode"))
            and "==" not in each
            and not fails(run(each, names))
        ]
    place = folder / which
    write_files(files, place)
    package = made.old.model.spec.protocol.name
    lines = [f"from {package} import *", *(f"print({each})" for each in statements)]
    (place / "program.py").write_text("\n".join([*lines, ""]), encoding="utf-8")
    words = ("-m", "mypy", "--no-incremental", "program.py")
    env = {"MYPYPATH": str(place / "generated"), "PATH": ""}
    done = ran(sys.executable, *words, status=None, cwd=place, env=env)
    return [line for line in done.stdout.splitlines() if line.startswith("program.py")]
