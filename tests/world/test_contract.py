"""The contract of `framegen check`: any change of a spec is either reported, or all of this holds.

Accepted means: it generates and imports; ruff, mypy and pyright have no findings; its client is
answered by its own device on every method; and its pages are inert. Each run takes some changes,
others for each `--seed`; `--sample all` takes every change, as `make fuzz` does; and `--only` those
whose description holds a text, as a failure shows it.
"""

import random
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import pytest
from framegen.compile import Compiled
from framegen.reading.yamltree import Unusable
from framegen.targets import python
from framegen.targets.python.names import names_of

from tests.factories import Data, compiled_of
from tests.lines.every_method import converse
from tests.mutations.healing import healed
from tests.mutations.mutants import (
    Mutant,
    rotations,
    singly,
    specs,
    stretched,
    structures,
    with_odd_text,
    with_texts,
)
from tests.side_by_side import Library, imported, library_of, linted, type_checked
from tests.unit.site.compared import not_inert, pages_of
from tests.unit.site.reference import Reference

# How many of each are some: specs full of odd text, and specs with one thing changed. Type checkers
# look at so many of each batch: they take as long for one as all else for twenty.
ODD_TEXTS, STRETCHED, CHANGED = 4, 8, 30
BATCH, TYPED, TYPED_OF_ALL = 300, 2, 20


@dataclass(frozen=True)
class Taken:
    """Which mutants a run takes: those that say a text, all of them, or some."""

    only: str
    is_all: bool
    seed: int

    @property
    def is_whole(self) -> bool:
        return self.is_all or bool(self.only)

    def of(self, mutants: list[Mutant], many: int) -> list[Mutant]:
        if self.is_whole or many >= len(mutants):
            return [mutant for mutant in mutants if self.only in str(mutant)]
        return random.Random(self.seed).sample(mutants, many)  # noqa: S311

    def report(self, failures: dict[str, list[str]]) -> None:
        """Show each failure by mutant, with the command that shows it alone."""
        lines = [f"seed {self.seed}"]
        for mutant, found in list(failures.items())[:20]:
            lines += [mutant, *(f"    {each}" for each in found[:5])]
            lines.append(f"    python -m pytest tests/world/test_contract.py --only {mutant!r}")
        if failures:
            pytest.fail("\n".join(lines))


@pytest.fixture
def taken(pytestconfig: pytest.Config) -> Taken:
    option = pytestconfig.option
    seed = 8 if option.seed is None else option.seed
    return Taken(option.only or "", option.sample == "all", seed)


def accepted(data: Data | None) -> Compiled | None:
    """Return the model of a spec, if `check` accepts it."""
    try:
        compiled = None if data is None else compiled_of(data)
    except Unusable:
        return None
    return None if compiled is None or compiled.findings else compiled


def library(name: str, compiled: Compiled) -> Library:
    return library_of(name, python.TARGET.render(compiled, {}))


@pytest.mark.parametrize("spec", specs())
def test_odd_text_changes_neither_code_nor_markup(taken: Taken, spec: str, tmp_path: Path) -> None:
    plain = with_texts(spec, {})
    compiled = accepted(plain.data)
    assert compiled is not None
    code, pages = library("plain", compiled).code, pages_of(plain.data)
    mutants = taken.of([with_odd_text(spec, each) for each in range(rotations())], ODD_TEXTS)
    failures = _effects_of_odd_text(mutants, code, pages, tmp_path / "all") if mutants else {}
    for mutant in [each for each in mutants if str(each) in failures][:2]:
        failures = _effects_of_odd_text(singly(mutant), code, pages, tmp_path / "singly") | failures
    taken.report(failures)


def _effects_of_odd_text(
    mutants: list[Mutant], code: str, pages: Reference, folder: Path
) -> dict[str, list[str]]:
    """Return the effects of odd text, by mutant."""
    found: dict[str, list[str]] = {}
    for at, mutant in enumerate(mutants):
        compiled = compiled_of(mutant.data)
        if compiled.findings:
            found[str(mutant)] = [f"{each.rule}: {each.message}" for each in compiled.findings]
            continue
        made = library(f"m{at}", compiled)
        made.write(folder)
        same = [] if made.code == code else ["the code says something else"]
        found[str(mutant)] = [*same, *not_inert(pages_of(mutant.data), pages)]
    for name, faults in linted(folder).items():
        found[str(mutants[int(name[1:])])] += faults
    shutil.rmtree(folder)
    return {mutant: faults for mutant, faults in found.items() if faults}


@pytest.mark.parametrize("spec", specs())
def test_names_of_any_length_are_fitted_to_lines(taken: Taken, spec: str, tmp_path: Path) -> None:
    mutants = taken.of([stretched(spec, length) for length in range(6, 61)], STRETCHED)
    for at, mutant in enumerate(mutants):
        library(f"m{at}", compiled_of(mutant.data)).write(tmp_path)
    found = linted(tmp_path) if mutants else {}
    taken.report({str(mutants[int(name[1:])]): faults for name, faults in found.items()})


# Whatever the author of a spec deprecates is sent and answered all the same.
@pytest.mark.filterwarnings("ignore:.* is deprecated:DeprecationWarning")
def test_a_changed_spec_makes_a_good_library(taken: Taken, tmp_path: Path) -> None:
    """As it is, or with lengths and examples to match; most changes are refused."""
    failures: dict[str, list[str]] = {}
    seen: set[str] = set()
    mutants = [mutant for spec in specs() for mutant in structures(spec)]
    typed = TYPED_OF_ALL if taken.is_whole else TYPED
    for batch in batches(chosen(taken, mutants)):
        failures |= _changed_wrongly(batch, seen, typed, tmp_path / "batch")
        shutil.rmtree(tmp_path / "batch")
    taken.report(failures)
    assert seen or taken.only


def chosen(taken: Taken, mutants: list[Mutant]) -> Iterator[tuple[Mutant, Compiled]]:
    """Return the mutants that `check` accepts, and their models; as many as a run takes."""
    mutants = taken.of(mutants, len(mutants))
    if not taken.is_whole:
        random.Random(taken.seed).shuffle(mutants)  # noqa: S311
    found = (
        (mutant, compiled)
        for mutant in mutants
        if (compiled := accepted(mutant.data) or accepted(healed(mutant.data))) is not None
    )
    return found if taken.is_whole else islice(found, CHANGED)


def batches(found: Iterator[tuple[Mutant, Compiled]]) -> Iterator[list[tuple[Mutant, Compiled]]]:
    while batch := list(islice(found, BATCH)):
        yield batch


def _changed_wrongly(
    changed: list[tuple[Mutant, Compiled]], seen: set[str], most: int, folder: Path
) -> dict[str, list[str]]:
    """Return what is wrong with the libraries of changed specs, by mutant."""
    sources, whole = folder / "sources", folder / "whole"
    whole.mkdir(parents=True)
    failures: dict[str, list[str]] = {}
    typed = 0
    for at, (mutant, compiled) in enumerate(changed):
        made = library(f"m{at}", compiled)
        made.write(sources)
        failures.setdefault(str(mutant), []).extend(_conversed(made, compiled, sources))
        # To a type checker, those that differ in numbers and texts alone are one.
        if typed < most and made.code not in seen:
            typed += 1
            seen.add(made.code)
            made.write(whole)
    for checked in (linted(sources), type_checked(whole, folder / "cache")):
        for name, faults in checked.items():
            failures[str(changed[int(name[1:])][0])] += faults
    return {mutant: faults for mutant, faults in failures.items() if faults}


def _conversed(made: Library, compiled: Compiled, folder: Path) -> Iterator[str]:
    try:
        with imported(made, folder) as module:
            converse(module, names_of(compiled.model).library)
    except Exception as error:  # noqa: BLE001 - whatever it is, it is reported with the mutant
        yield f"{type(error).__name__}: {error}"
