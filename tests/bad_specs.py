"""Specs with a mistake: good ones of a few lines, and tables of edits to them.

    python -m tests.bad_specs           lists them
    python -m tests.bad_specs NAME      prints one as a file

A file in tests/specs/bad has the cases of the rule that it is named after. A case begins with a
spec of tests/specs/bad/base (`lamps`, unless it names another as its `base`), changes it by `edits`
(see tests/mutations/spec_edits.py), and says what must be found: `message`, `path`, `hint` and
`see`; or that several times, as `findings`, each with its `rule` if that is another.
Instead of edits, a case may have a whole `text`; and a text that is no spec at all has a `refusal`.

The mark «» is around the place of a finding, to the column, and ⟦⟧ around another place to `see`.
Marks and findings have the same order. One mark can serve for all findings, and if the places to
see have another order, `see` is a mapping with the number of each. `{version}` in a message is that
of framegen. A finding has the `path` of the key or value that is marked, unless it says another.
An entry without a name has what the cases below it share, such as a `base` or a `hint`.
"""

import argparse
import itertools
import re
import sys
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any, TypeAlias

import yaml
from framegen import __version__
from framegen.reading.findings import Finding, Related, did_you_mean
from framegen.reading.source import Source, Span

from tests.mutations.spec_edits import EditError, edited, repeated, unmarked

FOLDER = Path(__file__).parent / "specs" / "bad"
BASES = FOLDER / "base"
VARIANTS = BASES / "variants.yaml"

Case: TypeAlias = dict[str, Any]

_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_SAID = {"rule", "message", "path", "hint", "see", "times"}
_KEYS = {"name", "base", "edits", "text", "refusal", "findings"}


@dataclass(frozen=True)
class BadSpec:
    """A spec with a mistake, and the findings that it must have."""

    name: str
    source: Source
    findings: list[Finding] = field(repr=False)
    refusal: str = ""


def tables() -> list[str]:
    """List the tables: the rules, and `unusable` for texts that are no spec at all."""
    return sorted(file.stem for file in FOLDER.glob("*.yaml"))


def names(table: str = "") -> list[str]:
    return [case["name"] for each in [table] * bool(table) or tables() for case in _cases(each)]


@cache
def bad_spec(name: str) -> BadSpec:
    """Make a bad spec by its name. Raises EditError if its edits or marks do not fit."""
    [(table, case)] = [
        (table, case) for table in tables() for case in _cases(table) if case["name"] == name
    ]
    try:
        return made(table, case)
    except EditError as error:
        raise EditError(f"{name}, in {table}.yaml: {error}") from None


def made(rule: str, case: Case) -> BadSpec:
    """Make a bad spec of an entry of a table. Raises EditError as bad_spec does."""
    if unknown := case.keys() - _KEYS - _SAID:
        raise EditError(f"a case has no `{min(unknown)}`")
    marked = _text(case)
    source = Source(f"{case['name']}.yaml", unmarked(marked))
    if "refusal" in case:
        return BadSpec(case["name"], source, [], case["refusal"])
    said = [each for entry in case.get("findings", [case]) for each in _repeated(entry)]
    places, others = _marked(marked, "«", "»"), _marked(marked, "⟦", "⟧")
    paths = _paths(source.text)
    if len(places) == 1:
        places *= len(said)
    see = _numbered(said)
    if (len(places), len(others)) != (len(said), sum(map(len, see))):
        raise EditError(
            f"{len(said)} findings and {sum(map(len, see))} places to see are reported,"
            f" and {len(places)} and {len(others)} are marked"
        )
    findings = [
        Finding(
            rule=each.get("rule", rule),
            span=span,
            path=each.get("path", paths.get((span.line, span.column), "")),
            message=each["message"].replace("{version}", __version__),
            hint=each.get("hint", ""),
            related=tuple(Related(others[number - 1], text) for number, text in seen.items()),
        )
        for span, each, seen in zip(places, said, see, strict=True)
    ]
    return BadSpec(case["name"], source, findings)


def base_names() -> list[str]:
    """List the good specs that cases begin with."""
    whole = {file.stem for file in BASES.glob("*.yaml") if file != VARIANTS}
    return sorted(whole | {str(variant["name"]) for variant in _load(VARIANTS)})


@cache
def base(name: str) -> str:
    for variant in _load(VARIANTS):
        if variant["name"] == name:
            return _text(variant)
    return (BASES / f"{name}.yaml").read_text(encoding="utf-8")


@cache
def _cases(table: str) -> list[Case]:
    cases: list[Case] = []
    shared: Case = {}
    for entry in _load(FOLDER / f"{table}.yaml"):
        if "name" in entry:
            cases.append({**shared, **entry})
        else:
            shared = entry
    return cases


@cache
def _load(file: Path) -> list[Case]:
    loaded: list[Case] = yaml.load(file.read_text(encoding="utf-8"), _LOADER)  # noqa: S506 - safe
    return loaded


def _text(case: Case) -> str:
    text = str(case["text"]) if "text" in case else base(case.get("base", "lamps"))
    return edited(text, *case.get("edits", ()))


def _repeated(said: Case) -> list[Case]:
    if "times" not in said:
        return [said]
    paths, messages = (repeated(said[key], said["times"]) for key in ("path", "message"))
    return [{**said, "path": p, "message": m} for p, m in zip(paths, messages, strict=True)]


def _numbered(said: list[Case]) -> list[dict[int, str]]:
    """Give numbers to the places to see, unless the case does so itself."""
    numbers = itertools.count(1)
    return [
        see if isinstance(see, dict) else {next(numbers): text for text in see}
        for see in (each.get("see", ()) for each in said)
    ]


def _marked(text: str, opens: str, closes: str) -> list[Span]:
    return [
        Span(number, len(unmarked(line[: found.start()])) + 1, len(unmarked(found[1])))
        for number, line in enumerate(text.split("\n"), 1)
        for found in re.finditer(f"{opens}(.*?){closes}", line)
    ]


def _paths(text: str) -> dict[tuple[int, int], str]:
    """Return the paths of keys and values, by line and column, as another reader of YAML has them.

    Where both begin at one place, it is the key. Of what is no YAML, nothing has a path.
    """
    found: dict[tuple[int, int], str] = {}

    def note(node: Any, path: str) -> None:
        found[node.start_mark.line + 1, node.start_mark.column + 1] = path

    def walk(node: Any, path: str) -> None:
        note(node, path)
        if isinstance(node, yaml.SequenceNode):
            for at, inner in enumerate(node.value):
                walk(inner, f"{path}[{at}]")
        elif isinstance(node, yaml.MappingNode):
            for key, inner in node.value:
                below = f"{path}.{key.value}".lstrip(".")
                walk(inner, below)
                note(key, below)

    with suppress(yaml.YAMLError, RecursionError):
        walk(yaml.compose(text, _LOADER), "")
    return found


def main(arguments: list[str] | None = None) -> None:
    """Print one of them, or the names of all."""
    parser = argparse.ArgumentParser("python -m tests.bad_specs", description=main.__doc__)
    parser.add_argument("name", nargs="?", metavar="NAME", help="one of them, or of their bases")
    name = parser.parse_args(arguments).name
    if name is None:
        print("\n".join(names()))
    elif name in base_names():
        sys.stdout.buffer.write(base(name).encode())
    elif name in names():
        sys.stdout.buffer.write(bad_spec(name).source.text.encode())
    else:
        parser.error(f"no bad spec `{name}`: {did_you_mean(name, names())}")


if __name__ == "__main__":
    main()
