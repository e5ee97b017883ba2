"""What the help of the command shows: lines to type, made of the examples of the spec."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.exchanges import exchanges
from framegen.targets.python.escape import Bracketed, literal
from framegen.targets.python.library_view import VerbView
from framegen.targets.python.message_view import MessageView

if TYPE_CHECKING:
    from framegen.targets.python.library_view import LibraryView


@dataclass(frozen=True, slots=True)
class CommandView:
    """The verbs that have to do with a port, and examples of each."""

    library: LibraryView

    @property
    def line_verbs(self) -> list[VerbView]:
        """The verbs in the order of the alphabet."""
        verbs = {each.verb: each.examples for each in self.library.line_verbs}
        for name, examples in self._more.items():
            lines = [f"{self.library.package} {name} {words}".rstrip() for words, _ in examples]
            shown = [
                Bracketed("(", [literal(line), literal(what)], "),").fitted(8)
                for line, (_, what) in zip(lines, examples, strict=True)
            ]
            verbs[name] = [*verbs.get(name, []), *shown]
        return [VerbView(name, verbs[name]) for name in sorted(verbs)]

    @property
    def _more(self) -> dict[str, list[tuple[str, str]]]:
        """Examples by verb: what to type after the verb, and what it does."""
        return {
            "bench-line": self._bench_line,
            "monitor": [
                ("--port COM7 --direction any -t absolute", "both ends of a line, the time of day"),
                ("--port COM7 --hide noise --json", "messages, for a program to read"),
            ],
            "send": [(words, what) for words, what, _ in self._questions],
            "replay": [
                ("line.hex --dry-run", "what would be sent, and when"),
                ("line.hex --port COM7", "what was recorded, once more"),
                ("line.hex --port COM7 --speed 0.5", "at half the pace"),
                ("line.bin --port COM7 --skip-noise", "raw bytes, of which some are no frames"),
            ],
        }

    @property
    def _bench_line(self) -> list[tuple[str, str]]:
        return [
            (f"{words} -n 20" if at else words, f"how long {reply} takes to come")
            for at, (words, _, reply) in enumerate(self._questions)
        ]

    @property
    def _questions(self) -> list[tuple[str, str, str]]:
        """An example of each question that the spec has one for, what it does, and its reply."""
        layout = self.library.layout
        found: list[tuple[str, str, str]] = []
        for exchange in exchanges(layout):
            message = MessageView(exchange.request, layout)
            if exchange.reply is not None and message.example is not None:
                words = " ".join([message.name, *message.command_words(message.example.values)])
                summary = message.layout.message.summary
                found.append((f"--port COM7 {words}", summary, exchange.reply.name))
        return found
