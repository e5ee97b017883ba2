"""The exchanges: what methods return, raise and refuse beside what their types say."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.effect import Effect
from framegen.comparison.programs.origins import frame_path

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.pair import Pair
    from framegen.model.exchanges import Exchange


def exchange_effects(pair: Pair) -> Iterator[Effect]:
    """Yield what becomes of what the methods of a client return, raise and refuse."""
    news = pair.new.model.exchanges_by_request
    for old in pair.old.model.exchanges:
        new = news.get(pair.messages.to_new.get(old.request.name, ""))
        if new is not None:
            yield from _raises(pair, old, new)
            yield from _results(pair, old, new)
            yield from _limits(pair, old, new)


def _raises(pair: Pair, old: Exchange, new: Exchange) -> Iterator[Effect]:
    if (old.refusal is None) != (new.refusal is None):
        does = "raises RefusedError where the device refuses; it raised NoReplyError"
        did = "does not raise RefusedError any more"
        yield _effect(old, new, "raises", did if new.refusal is None else does)
    if old.reply is None or new.reply is None:
        return
    failed, fails = old.failure, new.failure
    if (failed is None) != (fails is None):
        does = "raises FailureError where the reply says that it has failed; it returned the reply"
        did = "does not raise FailureError any more"
        yield _effect(old, new, "raises", did if fails is None else does)
    elif failed is not None and fails is not None:
        by = pair.fields(old.reply, new.reply).to_new.get(failed.name)
        if by != fails.name:
            text = f"raises FailureError by `{fails.name}`; it did by `{failed.name}`"
            yield _effect(old, new, "raises", text)
        elif old.good != new.good:
            text = f"raises FailureError unless `{fails.name}` is {new.good}; it was {old.good}"
            yield _effect(old, new, "raises", text)


def _results(pair: Pair, old: Exchange, new: Exchange) -> Iterator[Effect]:
    yield from _verb(old, new)
    if new.acknowledged and not old.acknowledged:
        text = f"tells whether it `started`, by {new.acknowledged}"
        yield _effect(old, new, "added", text, breaks=False)
    if new.lasts is not None and old.lasts is None:
        text = f"tells how long it lasts, by `{new.lasts.name}`, and takes `latest=`"
        yield _effect(old, new, "added", text, breaks=False)
    named = pair.messages.to_new.get(old.acknowledged or "")
    if old.acknowledged and new.acknowledged and named != new.acknowledged:
        text = f"is `started` by {new.acknowledged}; it was by {old.acknowledged}"
        yield _effect(old, new, "result", text)
    if old.lasts is not None and new.lasts is not None:
        field = pair.fields(old.request, new.request).to_new.get(old.lasts.name)
        if field != new.lasts.name:
            text = f"lasts as long as `{new.lasts.name}`; it did as long as `{old.lasts.name}`"
            yield _effect(old, new, "result", text)
    asks = old.reply is not None and new.reply is not None
    if asks and old.address is not None and new.address is not None:
        silent = {*old.silent.values()} ^ {*new.silent.values()}
        if silent:
            where = ", ".join(str(each) for each in sorted(silent))
            text = f"at address {where}, who answers is not who did"
            parts = frame_path(pair.old.model, old.request.frame.name)
            theirs = frame_path(pair.new.model, new.request.frame.name)
            paths = (*parts, old.address.name), (*theirs, new.address.name)
            yield Effect("programs", "result", *paths, f"`{new.method.name}()`: {text}")


def _verb(old: Exchange, new: Exchange) -> Iterator[Effect]:
    """Yield what becomes of the verb in a shell; one named after the method goes with that."""
    if old.request.message.verb and old.verb not in {new.verb, new.long_verb}:
        text = f"has the verb `{new.verb}` in a shell; it had `{old.verb}`"
        yield _effect(old, new, "result", text)
    elif new.request.message.verb and new.verb not in {old.verb, old.long_verb}:
        yield _effect(old, new, "added", f"has the verb `{new.verb}` in a shell", breaks=False)


def _limits(pair: Pair, old: Exchange, new: Exchange) -> Iterator[Effect]:
    """Yield where a client refuses by default what it took."""
    before = {name: each.usual for name, each in old.request.limited.items()}
    fields = pair.fields(old.request, new.request)
    for path, limits in new.request.limited.items():
        name, dot, inner = path.partition(".")
        was = fields.to_old.get(name)
        if was is None:
            continue
        known, usual = before.get(f"{was}{dot}{inner}"), limits.usual
        number = new.request.numbers_by_path[path]
        low, high = usual.low, number.high if usual.high is None else usual.high
        if known is None:
            wide = (number.low, number.high)
        else:
            wide = (known.low, number.high if known.high is None else known.high)
        if low > wide[0] or high < wide[1]:
            steps = ("fields", inner) if inner else ()
            text = (
                f"raises LimitError outside {low}..{high} by default; it took {wide[0]}..{wide[1]}"
            )
            yield Effect(
                "programs",
                "refused",
                ("messages", old.request.name, "fields", was, *steps),
                ("messages", new.request.name, "fields", name, *steps),
                f"`{new.method.name}()` {text} for `{path}`",
            )


def _effect(
    old: Exchange, new: Exchange, outcome: str, text: str, *, breaks: bool = True
) -> Effect:
    paths = ("messages", old.request.name), ("messages", new.request.name)
    return Effect("programs", outcome, *paths, f"`{new.method.name}()` {text}", breaks=breaks)
