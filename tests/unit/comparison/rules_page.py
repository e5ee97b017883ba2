"""The page of the rules of change: each with its example, and what that really breaks."""

from collections.abc import Iterable, Iterator

from framegen.comparison.changes import CHANGE_RULES
from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.comparison import Comparison
from framegen.comparison.effect import Effect
from framegen.comparison.report.ends import all_ends, ends_of
from framegen.comparison.report.verdict import standing

from tests.documents import ROOT
from tests.mutations.edits import edition
from tests.unit.comparison.rule_examples import example

PAGE = ROOT / "docs" / "what-changes-break.md"

_HEAD = """\
# What changes break

`framegen diff` compares two editions of a spec. It names each change by one of the rules below.
A rule says why a change matters and what to do about it.
What the change breaks is not fixed: `framegen diff` tries it out for each pair of editions,
with the frames of both, their requests and replies, and the libraries generated from them.

Each rule has an example, with what that breaks between a host, which has the library,
and a lamp, which answers.
One end has the edition before the change, the other the edition after it.
`as before` means that nothing changes, `new` that an old end does not understand what is new.
The examples show only the lines of the spec that matter.
In a shell, `framegen rules --changes` lists the rules, and `framegen rules ID` explains one.
"""
_SUBJECTS = {
    "line": "The line",
    "program": "What only programs notice",
    "frame": "The frame",
    "message": "Messages",
    "exchange": "Requests and replies",
    "field": "Fields",
    "value": "Named values and bits",
    "document": "Documentation",
}


def page() -> str:
    parts = [_HEAD, contents()]
    for subject, title in _SUBJECTS.items():
        parts.append(f"## {title}\n")
        parts += [f"{section(rule)}\n\n{verdicts(rule)}\n" for rule in _rules(subject)]
    return "\n".join(parts)


def contents() -> str:
    lines = [
        f"- {_link(title)}: " + ",\n  ".join(_link(rule.id) for rule in _rules(subject))
        for subject, title in _SUBJECTS.items()
    ]
    return "\n".join(lines) + "\n"


def _rules(subject: str) -> list[ChangeRule]:
    return [rule for rule in CHANGE_RULES if rule.subject == subject]


def _link(heading: str) -> str:
    return f"[{heading}](#{heading.lower().replace(' ', '-')})"


def section(rule: ChangeRule) -> str:
    """Return what the page says of a rule, without what its example breaks."""
    where = f", below {rule.at}" if rule.at else ""
    shown = [f"### {rule.id}", "", f"{rule.title}. {rule.why}", rule.do, "", "```yaml"]
    for edition_, lines in (("before", rule.before), ("after", rule.after)):
        shown.append(f"# {edition_}{where}" if lines else f"# {edition_}: nothing{where}")
        shown += lines.splitlines()
    return "\n".join([*shown, "```"])


def verdicts(rule: ChangeRule) -> str:
    """Return what the example of a rule breaks, as the page says it."""
    return "\n".join(_verdicts(rule))


def _verdicts(rule: ChangeRule) -> Iterator[str]:
    old, new = (edition(data) for data in example(rule))
    comparison = Comparison(old, new)
    effects = comparison.effects
    for axis in ("wire", "conversation"):
        ours = [effect for effect in effects if effect.axis == axis]
        told = [(ends_of(comparison.pair, effect), effect) for effect in ours]
        said = {
            str(ends): _said(effect for between, effect in told if between in (ends, None))
            for ends in all_ends(comparison.pair)
        }
        alike = len(set(said.values())) == 1
        both = next(iter(said.values()), "as before") if alike or not said else ""
        yield f"- {axis}: " + (both or "; ".join(f"{ends}: {one}" for ends, one in said.items()))
    yield f"- programs: {_said(each for each in effects if each.axis == 'programs')}"


def _said(effects: Iterable[Effect]) -> str:
    """Return how effects end: what breaks, or else that there is only something new."""
    standings = {(standing(each), each.outcome) for each in effects}
    broken = sorted({outcome for each, outcome in standings if each in ("breaks", "uncertain")})
    if broken:
        return ", ".join(f"**{outcome}**" for outcome in broken)
    return "new" if standings else "as before"


def write() -> None:
    text = page()
    if not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
        PAGE.write_text(text, encoding="utf-8", newline="\n")
        print(f"wrote {PAGE.name}")
