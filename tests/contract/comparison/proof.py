"""A second opinion on any two editions: the verdict on the wire is how their libraries talk."""

import ast
from collections.abc import Iterable, Iterator, Sequence
from copy import copy
from itertools import chain, zip_longest
from typing import Any

from framegen.comparison.changes import changes
from framegen.comparison.comparison import Comparison
from framegen.comparison.edition import Edition
from framegen.comparison.effect import OUTCOMES, Witness
from framegen.comparison.explained import is_documentation
from framegen.comparison.pair import Pair
from framegen.comparison.wire import Trial, Trials, try_out, wire_effects

from tests.contract.comparison.oracle import Oracle
from tests.contract.comparison.talks import SENDERS, Talk
from tests.factories import library_files
from tests.protocols.peer import Values

# Of the frames of a message, so many are judged again, and of the rest one of so many.
_ALL_OF = 60
_ONE_OF = 7
# Of the frames of a message, so many are put on a line with others.
_ON_A_LINE = 12
_SHORT = 0x100


def assert_each_frame_is_judged_right(talk: Talk) -> None:
    """Each frame that is tried is judged by what the libraries make of it: of many, some."""
    for oracle, trial, frames in talk.frames():
        for witness, breaks in [*frames[:_ALL_OF], *frames[_ALL_OF::_ONE_OF]]:
            judged = oracle.judge(trial.message, witness.values)
            assert (witness.outcome, breaks) == (judged.outcome, judged.breaks), witness


def assert_nothing_is_worse_than_its_verdict(
    drawn: Iterable[tuple[Oracle, Trial, Trials, Sequence[Values]]],
) -> None:
    """No frame, whatever its values, becomes worse than the worst that was tried.

    A frame that is not understood is refused, or misread where its bytes happen to be right for
    another, as one in 256 is for a checksum of a byte: one is as bad as the other.
    """
    for oracle, trial, tried, many in drawn:
        worst = max(map(_BADNESS.index, map(_bad, tried.counts)), default=0)
        for values in many:
            judged = oracle.judge(trial.message, values)
            assert _BADNESS.index(_bad(judged.outcome)) <= worst, (trial.message.name, values)
            assert not judged.breaks or tried.breaking is not None, (trial.message.name, values)


_BADNESS = OUTCOMES[:-1]


def _bad(outcome: Any) -> Any:
    return "refused" if outcome == "misread" else outcome


def assert_witnesses_show_it(talk: Talk) -> None:
    """Each witness, sent with one library and read with the other, shows what it claims."""
    for trials in talk.tried:
        for witness in (trials.breaking, trials.adding):
            if witness is not None:
                assert_shown(talk.oracles[witness.sender], trials, witness)


def assert_shown(oracle: Oracle, trials: Trials, witness: Witness) -> None:
    layout = trials.message
    assert oracle.encoded(oracle.ours, layout, witness.values) == witness.data
    judged = oracle.judge(layout, witness.values)
    assert judged.outcome == witness.outcome
    if judged.outcome == "refused":
        assert judged.reason in witness.reading
    elif judged.message != oracle.messages.to_new.get(layout.name):
        assert judged.message in witness.reading


def assert_mirrored(talk: Talk) -> None:
    """The comparison of the new edition with the old has the same cells, old and new swapped."""
    there, back = _cells(talk.tried), _cells(try_out(talk.pair.turned))
    swapped = {"old": "new", "new": "old"}
    assert {(swapped[sender], name): counts for (sender, name), counts in there.items()} == back


def _cells(trials: Iterable[Trials]) -> dict[tuple[str, str], dict[Any, int]]:
    return {(each.sender, each.message.name): each.counts for each in trials}


def assert_no_effect(pair: Pair) -> None:
    trials = try_out(pair)
    assert {outcome for each in trials for outcome in each.counts} <= {"same"}
    assert [*wire_effects(pair, trials)] == []


# ------------------------------------------------------------------ editions on one line


def assert_no_frame_is_lost(talk: Talk) -> None:
    """On a line with frames of both editions, whatever is understood alone is understood there.

    Frames come with a pause behind each, and without. Where there is none, a frame is safe unless
    its receiver still holds the bytes of one before it, of which it waits for more.
    """
    for way in {way for sender in SENDERS for way in talk.pair.edition(sender).model.directions}:
        for receiver in SENDERS:
            frames = _on_the_line(talk, receiver, way)
            if frames:
                assert_heard(talk, receiver, frames, paused=True)
                assert_heard(talk, receiver, frames, paused=False)


def _on_the_line(talk: Talk, receiver: str, way: Any) -> list[tuple[Any, bytes]]:
    """Return frames of both editions in turn, each with the direction that the receiver has."""
    several: dict[str, list[tuple[Any, bytes]]] = {sender: [] for sender in SENDERS}
    for _, trial, tried in talk.frames():
        if trial.message.direction == way:
            here = trial.way if trial.sender != receiver else way
            data = (witness.data for witness, _ in tried[:_ON_A_LINE])
            several[trial.sender] += [(here, each) for each in data if len(each) < _SHORT]
    turns = zip_longest(*several.values())
    return [frame for turn in turns for frame in turn if frame is not None]


def assert_heard(
    talk: Talk, receiver: str, frames: Sequence[tuple[Any, bytes]], *, paused: bool
) -> None:
    made = talk.old if receiver == "old" else talk.new
    decoders: dict[Any, Any] = {}
    for way, data in frames:
        name = None if way is None else f"{way.sender}_to_{way.receiver}".upper()
        if name is None or name not in made.Direction.__members__:
            continue
        direction = made.Direction[name]
        alone = made.StreamDecoder(direction)
        understood = _messages(made, chain(alone.feed(data), alone.flush()))
        decoder = decoders.setdefault(name, made.StreamDecoder(direction))
        waits = decoder.pending
        events = decoder.feed(data)
        if paused:
            events += decoder.flush()
        if not waits and [each.encode() for each in understood] == [data]:
            # It is held where a longer one may begin with it.
            heard = chain(events, copy(decoder).flush())
            assert _messages(made, heard) == understood, data.hex(" ")


def _messages(made: Any, events: Iterable[Any]) -> list[Any]:
    return [event for event in events if isinstance(event, made.Message)]


# ------------------------------------------------------------------ the code


def assert_words_alone_change_no_code(pair: Pair) -> None:
    """Where a comparison tells of nothing but words, the code of the libraries is the same.

    The name of a kind of frame is no word, though nobody outside a library sees it.
    """
    told = changes(pair)
    renamed = any(name != other for name, other in pair.frames.to_new.items())
    if (
        not renamed
        and all(map(is_documentation, told))
        and not Comparison(pair.old, pair.new).effects
    ):
        assert_same_code(pair.old, pair.new)


def assert_same_code(one: Edition, other: Edition) -> None:
    assert [*_other_code(one, other)] == []


def assert_other_code(one: Edition, other: Edition) -> None:
    assert [*_other_code(one, other)] != []


def _other_code(one: Edition, other: Edition) -> Iterator[str]:
    before, after = library_files(one.compiled), library_files(other.compiled)
    for name in before.keys() | after.keys():
        texts = before.get(name, ""), after.get(name, "")
        if texts[0] != texts[1] and name.endswith(".py") and not name.endswith("/_command.py"):
            codes = [ast.dump(_bare(ast.parse(text))) for text in texts]
            if codes[0] != codes[1]:
                yield name


def _bare(tree: ast.Module) -> ast.Module:
    """Remove each text that stands as a statement, which is a docstring, and vendors' names."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            node.body = [each for each in node.body if not _is_text(each)] or [ast.Pass()]
    return tree


def _is_text(statement: ast.stmt) -> bool:
    if isinstance(statement, ast.Assign):
        # What the document calls a message is a text that is shown, as a docstring is.
        names = [each.id for each in statement.targets if isinstance(each, ast.Name)]
        return names == ["VENDOR_NAME"]
    return (
        isinstance(statement, ast.Expr)
        and isinstance(statement.value, ast.Constant)
        and isinstance(statement.value.value, str)
    )
