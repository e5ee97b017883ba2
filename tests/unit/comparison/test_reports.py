"""Reports on a comparison: the same facts in each format, and nothing of a spec that takes over."""

import json
import re
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from framegen.comparison.accepted import Accepted, accepted_breaks
from framegen.comparison.changes.change import Change
from framegen.comparison.comparison import Comparison
from framegen.comparison.edition import Edition
from framegen.comparison.effect import Effect, Witness
from framegen.comparison.report import FORMATS
from framegen.comparison.report.ends import Ends, all_ends, ends_of, upgrade_order
from framegen.comparison.report.verdict import (
    AXES,
    BREAKS,
    FAILURES,
    NO_VERSION,
    UNCERTAIN,
    USUAL_FAILURES,
    exit_status,
    standing,
)
from framegen.comparison.report.view import View
from framegen.reading.source import Source
from framegen.reading.yamltree import dotted, read_tree
from hypothesis import example, given
from hypothesis import strategies as st

from tests.few_each import few_each
from tests.in_turn import in_turn
from tests.mutations.edits import EDITS, SPECS, edition, pair_of
from tests.mutations.places import renamed, with_

HOUSE = SPECS["greenhouse"]
NAMES = [*HOUSE["messages"]]
HOSTILE = [
    *("::error::x", "x\n::error::y", "x\r::stop-commands::y", "##[error]z", "%0A::error::x"),
    *("a | b ``` c", "```\nend", "<script>alert(1)</script>", "[a](http://b)", "\x1b[31mred\x07"),
    *("\u202egnal", "- a: {b: [c", "'\"", ""),
]
TEXTS = st.one_of(st.sampled_from(HOSTILE), st.text(max_size=30))
WITNESSES = st.builds(
    Witness,
    sender=st.sampled_from(["old", "new"]),
    data=st.binary(min_size=1, max_size=90),
    message=st.sampled_from(NAMES),
    values=st.dictionaries(st.sampled_from("abc"), st.one_of(TEXTS, st.floats(), st.integers())),
    outcome=st.sampled_from(["refused", "misread"]),
    reading=TEXTS,
)
PATHS = st.sampled_from([("messages", name) for name in NAMES] + [("link", "baud"), ()])
ENDS = ["old gateway, new station", "new gateway, old station", "old station, new gateway", ""]


@st.composite
def effects(draw: st.DrawFn) -> Effect:
    """Return an effect on users of the greenhouse, told in any words."""
    path = draw(PATHS)
    return Effect(
        axis=draw(st.sampled_from(AXES)),
        outcome=draw(st.sampled_from(["refused", "removed", "no reply"])),
        old=path,
        new=draw(st.sampled_from([path, None])),
        text=draw(TEXTS),
        ends=draw(st.sampled_from(ENDS)),
        breaks=draw(st.booleans()),
        certain=draw(st.booleans()),
        witness=draw(st.none() | WITNESSES),
        accepted=draw(TEXTS),
    )


CHANGES = st.builds(Change, rule=st.just("field-type"), old=PATHS, new=PATHS, text=TEXTS)


BEFORE, AFTER = edition(HOUSE, "v1:spec/a.yaml"), edition(HOUSE, "spec/a.yaml")


def comparison_of(
    found: list[Effect], changes: list[Change] | None = None, after: Edition = AFTER
) -> Comparison:
    comparison = Comparison(BEFORE, after)
    vars(comparison).update(effects=found, changes=changes or [], trials=[])
    return comparison


def view_of(found: list[Effect], changes: list[Change] | None = None) -> View:
    return View(comparison_of(found, changes))


VIEWS = st.builds(view_of, st.lists(effects(), max_size=4), st.lists(CHANGES, max_size=3))
HIDDEN = re.compile(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e]")


@few_each
@given(VIEWS)
@example(view_of([Effect("wire", "refused", None, ("messages", "VentsOpen"), "\n::error::x")]))
def test_nothing_of_a_spec_begins_a_line_of_the_text(view: View) -> None:
    shown = FORMATS["text"](view)
    assert HIDDEN.search(shown) is None
    # A line of ours is a blank one, a heading, or indented.
    headings = {"greenhouse", "all", "documentation", "without", *NAMES}
    for line in shown.splitlines():
        first = re.split(r"[ :(]", line, maxsplit=1)[0]
        assert not first or first in headings or re.match(r"\d+ messages: ", line), line


@few_each
@given(VIEWS)
def test_github_is_given_a_command_for_each_break_and_no_other(view: View) -> None:
    lines = FORMATS["github"](view).split("\n")
    commands = [line for line in lines if line.lstrip().startswith("::")]
    levels = {"breaks": "error", "uncertain": "warning", "accepted": "notice"}
    # One for each message and each two ends, on whichever axis it breaks; programs are their own.
    breaking = [each for each in view.effects if each.breaks]
    ends = [each.axis == "programs" or str(ends_of(view.pair, each)) for each in breaking]
    about = {(standing(each), each.path[:2], end) for each, end in zip(breaking, ends, strict=True)}
    wanted = Counter(levels[how] for how, *_ in about)
    wanted["warning"] += view.version_finding is not None
    assert Counter(line[2:].partition(" ")[0] for line in commands) == +wanted
    place = r"file=spec/a\.yaml,line=\d+,col=\d+,title=[^:]*::"
    for line in commands:
        assert re.match(f"::(error|warning|notice) {place}", line), line
    assert not any("##[" in line for line in lines if line not in commands)
    assert not any("\r" in line for line in lines)


def test_what_becomes_of_one_request_is_one_annotation() -> None:
    ends, path = "old gateway, new station", ("messages", "VentsOpen")
    refused = Effect("wire", "refused", path, path, "VentsOpen: is refused", ends)
    lost = Effect("conversation", "no reply", path, path, "VentsOpen gets no reply", ends)
    (command, *rest) = FORMATS["github"](view_of([refused, lost])).splitlines()
    assert command.startswith("::error ")
    assert "title=wire and conversation%2C old gateway with new station::" in command
    assert command.endswith("VentsOpen: is refused%0AVentsOpen gets no reply")
    assert not any(line.startswith("::error") for line in rest)


@pytest.mark.parametrize("name", ["spec/li ft,x:y.yaml", "spec/plain.yaml"])
def test_an_annotation_is_of_the_file_whatever_it_is_called(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "spec").mkdir()
    (tmp_path / name).write_text("")
    for label in (name, "v1:spec/plain.yaml"):
        said = name if label == name else "spec/plain.yaml"
        shown = FORMATS["github"](View(comparison_of([CERTAIN], after=edition(HOUSE, label))))
        assert f"file={said.replace(':', '%3A').replace(',', '%2C')},line=" in shown


def test_a_frame_is_shown_as_a_whole() -> None:
    path = ("messages", "VentsOpen")
    witness = Witness("old", bytes(range(256)), "VentsOpen", {}, "misread", "is read otherwise")
    view = view_of([Effect("wire", "misread", path, path, "It.", "", witness=witness)])
    for name, render in FORMATS.items():
        assert bytes(range(256)).hex(" ").upper() in render(view), name


def test_a_guess_is_no_fact_in_a_title() -> None:
    data = renamed(HOUSE, "VentsOpen", "VentsTurn")
    said = with_(data, "messages", "VentsTurn", "was", "VentsOpen")
    for new, title in ((data, "VentsTurn (may be VentsOpen)"), (said, "VentsTurn (was VentsOpen)")):
        view = View(Comparison(BEFORE, edition(new)))
        assert title in FORMATS["text"](view).splitlines()


def test_a_unit_that_may_be_another_is_told_with_the_way_to_settle_it() -> None:
    field = ("messages", "VentsOpen", "fields", "ramp_s")
    plain = with_(HOUSE, *field, {"type": "u8", "about": "How long."})
    old, new = (edition(with_(plain, *field, "unit", each)) for each in ("knots", "kn"))
    shown = FORMATS["text"](View(Comparison(old, new)))
    assert "ramp_s = 1 knots is read as 1 kn, which may be another unit" in shown
    assert "`breaks` of the `history`" in shown


def test_what_is_reserved_is_no_documentation_and_each_change_has_its_place() -> None:
    change = Change("reserved-added", None, ("messages",), "reserved[0] is new: id 3")
    words = Change("words", ("link",), ("link",), "link: in other words")
    shown = FORMATS["text"](view_of([], [change, words])).splitlines()
    for heading, said in (
        ("without effect: 1 change that no end and no program notices", change.text),
        ("documentation: 1 change that nothing depends on", words.text),
    ):
        at = shown.index(heading)
        assert shown[at + 1] == f"  {said}"
        assert shown[at + 2].startswith("    spec/a.yaml:")


@few_each
@given(VIEWS)
def test_markdown_has_no_markup_of_a_spec(view: View) -> None:
    shown = FORMATS["markdown"](view)
    assert shown.count("```") in {0, 2}
    outside = "".join(shown.split("```")[::2])
    plain = re.sub(r"`[^`\n]*`", "", outside)
    assert "<" not in plain
    assert "](" not in plain.replace("\\]", "")
    tables = [line for line in shown.splitlines() if line.startswith("|")]
    cells = [len(re.findall(r"(?<!\\)\|", line)) for line in tables]
    assert set(cells) <= {4, 6}


@few_each
@given(VIEWS)
def test_json_says_all_that_was_found(view: View) -> None:
    shown = FORMATS["json"](view)
    assert shown.count("\n") == 1
    report = json.loads(shown, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    for told, effect in zip(report["effects"], view.effects, strict=True):
        said = [told[key] for key in ("axis", "standing", "text", "old")]
        assert said == [effect.axis, standing(effect), effect.text, dotted(effect.old or ())]
        frame = told["witness"] and bytes.fromhex(told["witness"]["hex"])
        assert frame == (effect.witness and effect.witness.data)
    counted = Counter[str]()
    for verdict in report["verdicts"]:
        for name, outcomes in verdict["counts"].items():
            counted[name] += sum(outcomes.values())
    assert counted == Counter(map(standing, view.effects))
    texts = [each.text for each in view.comparison.changes]
    assert [each["text"] for each in report["changes"]] == texts


@few_each
@given(st.lists(CHANGES, min_size=1, max_size=3))
def test_the_entry_for_the_history_is_what_a_spec_can_hold(changes: list[Change]) -> None:
    view = view_of([], changes)
    shown = FORMATS["markdown"](view)
    entry = shown.partition("```yaml\n")[2].partition("\n```")[0]
    tree, findings = read_tree(Source("entry.yaml", f"history:\n{entry}\n"))
    said = tree.data["history"][0]
    assert said["version"] == view.next_version
    assert len(said["changes"]) == len(view.sentences)
    assert not [each for each in findings if each.rule != "invisible-character"]


# ------------------------------------------------------------------ verdicts

CERTAIN = Effect("wire", "refused", (), (), "")
GUESS = Effect("wire", "uncertain", (), (), "", certain=False)
MEANT = Effect("wire", "refused", (), (), "", accepted="It is meant.")
NEW = Effect("wire", "refused", None, (), "", breaks=False)
RUN = Effect("programs", "removed", (), None, "")
MISSING = "something breaks"
EVERY = frozenset(FAILURES[:-1])


@in_turn(
    "found, finding, fail_on, status",
    lambda: [
        *(([], None, EVERY, 0), ([], MISSING, EVERY, NO_VERSION), ([], MISSING, USUAL_FAILURES, 0)),
        *(([CERTAIN], None, USUAL_FAILURES, BREAKS), ([CERTAIN], MISSING, EVERY, BREAKS)),
        ([CERTAIN], MISSING, frozenset(["version"]), NO_VERSION),
        ([CERTAIN], None, frozenset(["programs", "conversation", "uncertain"]), 0),
        *(([GUESS], None, USUAL_FAILURES, UNCERTAIN), ([GUESS], MISSING, EVERY, UNCERTAIN)),
        *(([GUESS], None, frozenset(AXES), 0), ([GUESS, CERTAIN], None, USUAL_FAILURES, BREAKS)),
        ([GUESS, RUN], None, frozenset(["wire", "uncertain"]), UNCERTAIN),
        *(([MEANT, NEW], None, EVERY, 0), ([MEANT, GUESS], None, EVERY, UNCERTAIN)),
        ([CERTAIN, GUESS, RUN], MISSING, frozenset(["never"]), 0),
    ],
)
def test_the_worst_that_counts_gives_the_exit_status(
    found: list[Effect], finding: str | None, fail_on: frozenset[str], status: int
) -> None:
    assert exit_status(found, finding, fail_on) == status


@few_each
@given(st.lists(effects()), st.sets(st.sampled_from(FAILURES[:-1])))
def test_what_breaks_nothing_and_what_is_accepted_never_counts(
    found: list[Effect], fail_on: set[str]
) -> None:
    counting = [each for each in found if each.breaks and not each.accepted]
    status, less = (exit_status(some, None, frozenset(fail_on)) for some in (found, counting))
    assert status == less


@in_turn(
    "ends, said",
    lambda: [
        ("old gateway, new station", "old gateway with new station"),
        ("new station, old gateway", "old gateway with new station"),
        ("new gateway, old station", "new gateway with old station"),
        ("old display, new gateway", "new gateway with old display"),
        ("", "None"),
    ],
)
def test_who_talks_to_whom_does_not_depend_on_who_sends(ends: str, said: str) -> None:
    effect = Effect("wire", "refused", (), (), "", ends)
    assert str(ends_of(pair_of(HOUSE, HOUSE), effect)) == said


def test_each_two_ends_between_which_messages_go_have_two_verdicts() -> None:
    assert [*map(str, all_ends(pair_of(HOUSE, HOUSE)))] == [
        "old gateway with new station",
        "new gateway with old station",
        "old gateway with new display",
        "new gateway with old display",
    ]


SOME = ["name of an end", "direction", "message added"]


@pytest.mark.parametrize("name", SOME)
def test_every_effect_is_between_ends_that_have_a_verdict(name: str) -> None:
    old, new = EDITS[name]
    view = View(Comparison(edition(old), edition(new)))
    vars(view.comparison)["changes"] = []
    known = {*all_ends(view.pair), None}
    for effect in view.effects:
        assert ends_of(view.pair, effect) in known
    assert sum(len(each.effects) for each in view.verdicts) == len(view.effects)
    assert sum(len(each.effects) for each in view.sections) == len(view.effects)


HOST, BOARD = Ends("host", "board", old_first=True), Ends("host", "board", old_first=False)
LAMP = Ends("host", "lamp", old_first=False)


BOTH_AT_ONCE = "both ends at once: each breaks with the old edition of the other"


@in_turn(
    "broken, said",
    lambda: [
        # An old host breaks with a new board, so that no board is upgraded before its host.
        ([HOST], "every host before any board"),
        ([BOARD], "every board before any host"),
        ([HOST, LAMP], "every host before any board, and every lamp before any host"),
        ([Ends("host", "host", old_first=True)], BOTH_AT_ONCE),
        ([HOST, BOARD], BOTH_AT_ONCE),
    ],
)
def test_the_end_that_breaks_while_old_is_upgraded_first(broken: list[Ends], said: str) -> None:
    assert upgrade_order(broken) == said


# ------------------------------------------------------------------ what is accepted


@in_turn(
    "line, path, covered",
    lambda: [
        ("messages.A", ("messages", "A"), True),
        ("messages.A", ("messages", "A", "fields", "b"), True),
        ("messages.A", ("messages", "AB"), False),
        ("messages.A.fields.b", ("messages", "A"), False),
        ("messages.A.examples", ("messages", "A", "examples", 0), True),
        ("messages.A.examples[1]", ("messages", "A", "examples", 0), False),
        ("link", ("link", "baud"), True),
        ("link", None, False),
    ],
)
def test_what_is_accepted_covers_what_is_below_it(
    line: str, path: tuple[str | int, ...] | None, covered: bool
) -> None:
    assert Accepted("2.0.0", line, "It is meant.").covers(path) is covered


def accepting(*releases: tuple[str, dict[str, str]]) -> dict[str, Any]:
    said = {"changes": ["It."]}
    return with_(HOUSE, "history", [{**said, "version": v, "breaks": b} for v, b in releases])


FIRST, SECOND = ("1.0.0", {"link": "Faster."}), ("2.0.0", {"messages.A": "Gone.", "link": "More."})


@in_turn(
    "old, new, paths",
    lambda: [
        ([FIRST], [FIRST], []),
        ([FIRST], [SECOND, FIRST], ["messages.A", "link"]),
        ([SECOND, FIRST], [FIRST], []),
        ([("2.0.0", {"link": "More."})], [SECOND], ["messages.A"]),
        # Another reason is another decision.
        ([("2.0.0", {"link": "Much more."})], [("2.0.0", {"link": "More."})], ["link"]),
    ],
)
def test_only_what_the_old_history_has_not_is_accepted(
    old: list[Any], new: list[Any], paths: list[str]
) -> None:
    pair = pair_of(accepting(*old), accepting(*new))
    assert [each.path for each in accepted_breaks(pair)] == paths


def compared(accepts: dict[str, str], changes: list[Change]) -> list[Effect]:
    """Return the effects of another id of StationRead, of which the history accepts something."""
    bare = with_(HOUSE, "messages", "StationRead", "examples", [])
    entry = {"version": "2.0.0", "changes": ["It."], "breaks": accepts}
    new = with_(with_(bare, "messages", "StationRead", "id", 0x20), "history", [entry])
    comparison = Comparison(edition(bare), edition(new))
    vars(comparison)["changes"] = changes
    return [each for each in comparison.effects if each.axis == "wire"]


PATH = ("messages", "StationRead", "id")
ID = Change("message-id", PATH, PATH, "0x11 became 0x20")
SUMMARY = Change("words", ("messages", "TextShow", "summary"), None, "is said otherwise")


@in_turn(
    "accepts, reasons",
    lambda: [
        ({}, {""}),
        ({"messages.TextShow": "Old."}, {""}),
        ({"messages.StationRead": "Old."}, {"Old."}),
        # All that is behind it is accepted.
        ({"messages.StationRead.id": "Old."}, {"Old."}),
        ({"messages.StationRead.fields": "Old."}, {""}),
    ],
)
def test_a_break_is_accepted_by_its_message_or_by_its_cause(
    accepts: dict[str, str], reasons: set[str]
) -> None:
    found = [each for each in compared(accepts, [ID]) if each.breaks]
    assert {each.accepted for each in found} == reasons


def test_what_breaks_only_by_what_the_author_says_is_a_break_that_is_accepted() -> None:
    found = compared({"messages.TextShow.summary": "It was wrong."}, [ID, SUMMARY])
    (declared,) = (each for each in found if each.outcome == "declared")
    assert (declared.breaks, declared.accepted) == (True, "It was wrong.")
    assert declared.path == ("messages", "TextShow", "summary")
