"""The command of a library: its library, its verbs, and the texts of its help."""

from __future__ import annotations

import sys
from functools import cached_property

from ..part import part_of
from .own_verbs import EXAMPLES, FIRST, OTHERS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

    from ..client.library import Library


class Program:
    """What a generated library hands to its command, and the command to each of its verbs.

    `name` is what is typed, `package` the import name of the library, and `summary` says what it is
    for. `has` is what its own verbs need. `verbs` are those chosen for messages, and `method_verbs`
    those named after methods, each with what it is for and the arguments of an example. `methods`
    has the message that a verb sends, and `pose_methods` that of a verb that reads or commands
    positions. `long` has the verb that is meant by a longer name. `stop_message` is what `stop`
    sends before it holds, and `stop_summary` says so; empty for nothing. `in_examples` is what
    examples of own verbs have of the protocol: a `frame` in hex and its `sender`, the name of a
    `message`, a `word` of it, its `number` and the `part` of the frame where that is, and an `end`
    that sends. `examples` has whole ones, as arguments with what they do.
    """

    def __init__(
        self,
        name: str,
        package: str,
        *,
        summary: str,
        has: Collection[str],
        verbs: Mapping[str, tuple[str, str]],
        method_verbs: Mapping[str, tuple[str, str]],
        methods: Mapping[str, str],
        pose_methods: Mapping[str, str],
        long: Mapping[str, str],
        stop_message: str,
        stop_summary: str,
        in_examples: Mapping[str, str],
        examples: Mapping[str, Iterable[tuple[str, str]]],
    ) -> None:
        self.name = name
        self.package = package
        self.summary = summary
        self.methods = methods
        self.pose_methods = pose_methods
        self.long = long
        self.stop_message = stop_message
        self._stop_summary = stop_summary
        self._has = {"", *has, *in_examples}
        self._chosen = verbs
        self._method_verbs = method_verbs
        self._in_examples = in_examples
        self._examples = examples

    def __repr__(self) -> str:
        return f"<the command {self.name} of the library {self.package}>"

    def main(self, argv: Sequence[str] | None = None) -> int:
        """Run a command line, without one that of the process; return its exit status."""
        from .command import run

        return run(self, sys.argv[1:] if argv is None else list(argv))

    @cached_property
    def verbs(self) -> Mapping[str, str]:
        """What each verb is for, in the order of the help."""
        return {
            **self._own(FIRST),
            **{verb: summary for verb, (summary, _) in self._chosen.items()},
            **self._own(OTHERS),
            **{verb: summary for verb, (summary, _) in self._method_verbs.items()},
        }

    def _own(self, rows: Iterable[tuple[str, str, str]]) -> dict[str, str]:
        found = {verb: summary for verb, needs, summary in rows if needs in self._has}
        if self._stop_summary and "stop" in found:
            found["stop"] = self._stop_summary
        return found

    @cached_property
    def examples(self) -> Mapping[str, tuple[tuple[str, str], ...]]:
        """Command lines of each verb, with what they do."""
        found: dict[str, list[tuple[str, str]]] = {verb: [] for verb in self.verbs}
        for verb, words, meaning in self._lines():
            found[verb].append((f"{self.name} {verb} {words}".rstrip(), meaning))
        return {verb: tuple(lines) for verb, lines in found.items()}

    def _lines(self) -> Iterator[tuple[str, str, str]]:
        """Yield a verb, arguments of an example, and what it does."""
        frame = self._in_examples["frame"]
        parts = {"joined": frame.replace(" ", ""), "cut": frame.rpartition(" ")[0]}
        parts |= self._in_examples
        for verb, needs, words, meaning in EXAMPLES:
            if needs in self._has:
                yield verb, words.format_map(parts), meaning.format_map(parts)
        for verb, lines in self._examples.items():
            yield from ((verb, words, meaning) for words, meaning in lines)
        for verb, (summary, words) in {**self._chosen, **self._method_verbs}.items():
            yield verb, words, summary

    @cached_property
    def library(self) -> Library:
        """The library, which is not imported for those who only look around."""
        library: Library = part_of(self.package, "_library").LIBRARY
        return library

    @property
    def port_variable(self) -> str:
        """The environment variable that names the port where no option does."""
        return f"{self.name.upper()}_PORT"

    @property
    def settings_file(self) -> str:
        """The name of the file of settings."""
        return f"{self.name}.toml"

    @property
    def simulator(self) -> str:
        """The package of the simulator, which need not be installed."""
        return f"{self.name}_simulator"
