"""What becomes of a program that uses all of an old library, when it is given the new one."""

from dataclasses import dataclass
from functools import cache

from framegen.comparison.edition import Edition
from framegen.comparison.effect import Effect
from framegen.comparison.pair import Pair
from framegen.comparison.programs import program_effects
from framegen.comparison.programs.rendered import NoLibrary, rendered
from framegen.model.exchanges import method_of, snake_case
from framegen.targets.python.names import names_of

from tests.contract.comparison.program_of_all import fails, namespace, program, run
from tests.factories import library

# What a program notices in a type checker alone, or at a line that is not there.
_UNSEEN = ("type", "meaning", "raises", "result")
_ELSEWHERE = ("link", "protocol", "pose")


@dataclass(frozen=True)
class Verdict:
    """The effects that are told, and the statements whose results are others."""

    effects: list[Effect]
    differing: list[str]

    @property
    def breaking(self) -> list[Effect]:
        return [each for each in self.effects if each.breaks]

    @property
    def seen(self) -> list[Effect]:
        return [
            each
            for each in self.breaking
            if each.outcome not in _UNSEEN
            and each.path[0] not in _ELSEWHERE
            # Frames that two messages may be are of a few values alone, which it need not try.
            and not each.text.startswith("`decode(")
        ]


def files_of(edition: Edition) -> dict[str, str] | None:
    """Return the library of an edition, by path; None where nothing can be made of it."""
    try:
        files = rendered(edition)
    except NoLibrary:
        return None
    folder = f"generated/{edition.model.spec.protocol.name}"
    return {f"{folder}/{path}": text for path, text in files.items()}


@cache
def _results(edition: Edition) -> dict[str, object]:
    """Return what each statement gives with the library that the program was written for."""
    files = files_of(edition)
    assert files is not None
    with library(files) as made:
        names = namespace(made)
        found = {each: run(each, names) for each in dict.fromkeys(program(made))}
    return {each: result for each, result in found.items() if not fails(result)}


def verdict_on(pair: Pair) -> Verdict | None:
    """Return what is told of programs, and what becomes of one; None for what is no library."""
    files = files_of(pair.new)
    if files is None or files_of(pair.old) is None:
        return None
    with library(files) as made:
        names = namespace(made)
        differing = [
            each for each, result in _results(pair.old).items() if run(each, names) != result
        ]
    # Which reply a client takes for its own is a matter of the conversation, and so is how many
    # items a device replies with.
    if not _replies_alike(pair):
        differing = [each for each in differing if "asked(" not in each]
    for name in _counted_otherwise(pair):
        handler = f"handled('on_{snake_case(names_of(pair.old.model).of('message', name))}'"
        differing = [each for each in differing if not each.startswith(handler)]
    return Verdict([*program_effects(pair)], differing)


def _replies_alike(pair: Pair) -> bool:
    old, new = (
        {each.request.name: (each.echoed, each.reply and each.reply.name) for each in found}
        for found in (pair.old.model.exchanges, pair.new.model.exchanges)
    )
    alike = all(new.get(name, echoed) == echoed for name, echoed in old.items())
    return alike and not _counted_otherwise(pair)


def _counted_otherwise(pair: Pair) -> list[str]:
    """Return the requests that ask for so many items in one edition alone, or by other fields."""
    old, new = (
        {each.request.name: each.asks_for for each in found}
        for found in (pair.old.model.exchanges, pair.new.model.exchanges)
    )
    return [name for name, asks_for in old.items() if new.get(name, asks_for) != asks_for]


def names_about(effect: Effect, pair: Pair) -> set[str]:
    """Return the names of the old library that an effect on a message may be seen at."""
    assert effect.old is not None
    names, message = names_of(pair.old.model), str(effect.old[1])
    layout = pair.old.model.messages[message]
    made = names.of("message", message)
    found = {made, snake_case(made), names.of("method", method_of(message, layout.message).name)}
    elements = [getattr(each, "element", None) for each in layout.message.fields.values()]
    return found | {names.of("element", each) for each in elements if each is not None}
