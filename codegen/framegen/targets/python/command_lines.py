"""The verbs of the command: what each is for, and example command lines for its help."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from framegen.language.command_verbs import OF_POSES, STOP, VERBS
from framegen.model.exchanges import snake_case
from framegen.model.slots import Items
from framegen.targets.python.characters import columns
from framegen.targets.python.escape import WIDTH, Bracketed, Text, literal
from framegen.targets.python.message_view import MessageView

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model

# What stands behind a verb, and what it does.
_Line: TypeAlias = tuple[str, str]
# What each of the command's own verbs is for.
_ABOUT = {
    "ports": "List the serial ports, and devices that have none.",
    "doctor": "Diagnose a port, a line or a device.",
    "stop": "Stop: hold everything where it is.",
    "hold": "Hold what moves or is limp, where it is.",
    "monitor": "Show the traffic of a line as it arrives.",
    "teach": "Switch the device off, and record poses set by hand.",
    "play": "Play recorded poses.",
    "decode": "Decode bytes: messages, and noise with the reason.",
    "explain": "Take a frame apart byte by byte, or show where and why bytes are no frame.",
    "docs": "Look up a message: its bytes, fields and examples, and what is known of it.",
    "encode": "Make the frame of a message.",
    "send": "Send a message to a port.",
    "stats": "Show what a line carried: counts, rates, gaps, noise and values.",
    "replay": "Send a recording again.",
    "simulate": "Run a virtual device to talk to.",
    "answer": "Answer questions on standard input: a codec for programs in any language.",
    "bench-line": "Measure how long queries take on a line, compared with what it allows.",
}
# What a verb does where there are questions.
_OF_QUESTIONS = {"send": "Send a message to a port, and print the reply."}
# The verbs of messages stand in front of this one.
_AFTER_MESSAGES = STOP


@dataclass(frozen=True, slots=True)
class VerbView:
    """A verb of the command, what it is for, and its examples."""

    name: str
    about: str
    examples: list[Bracketed]

    @property
    def told(self) -> str:
        """What it is for as the entry of a dict, in brackets where it takes several lines."""
        line = f"{literal(self.name)}: {literal(self.about)},"
        if 4 + columns(line) <= WIDTH:
            return line
        return f"{literal(self.name)}: (\n        {Text(self.about).fitted(8)}\n    ),"

    @property
    def entry(self) -> str:
        """The examples as the entry of a dict."""
        return Bracketed(f"{literal(self.name)}: (", [*self.examples], "),", lone=",").fitted(4)


def verbs(model: Model) -> list[VerbView]:
    """Return the verbs that this protocol has a use for, in the order of the help."""
    program = model.spec.protocol.name
    about = _ABOUT | (_OF_QUESTIONS if _questions(model) else {})
    examples = _examples(model)
    said = {exchange.verb: exchange.request.message.summary for exchange in messages_by_verb(model)}
    # Where nothing has a pose, what a message is called is the message.
    meant = {*said} if model.spec.pose is None else {*said} - {STOP}
    own = {name: about[name] for name in VERBS if name in examples and name not in meant}
    if STOP in own and STOP in said:
        own[STOP] = f"{said[STOP].rstrip('.')}, then hold everything where it is."
    named = {each.verb for each in messages_by_verb(model) if each.request.message.verb}
    order = [
        *(name for name in own if VERBS.index(name) < VERBS.index(_AFTER_MESSAGES)),
        *(name for name in said if name in named and name not in own),
        *(name for name in own if VERBS.index(name) >= VERBS.index(_AFTER_MESSAGES)),
        *(name for name in said if name not in named and name not in own),
    ]
    found: list[VerbView] = []
    for verb in order:
        lines = examples[verb]
        shown = [(f"{program} {verb} {words}".rstrip(), meaning) for words, meaning in lines]
        found.append(VerbView(verb, (said | own)[verb], _pairs(shown)))
    return found


def messages_by_verb(model: Model) -> list[Exchange]:
    """Return the messages that have a verb of their own; `send` reaches the others."""
    taken = {*VERBS} - (OF_POSES if model.spec.pose is None else {STOP})
    found: dict[str, Exchange] = {}
    for exchange in sorted(model.exchanges, key=lambda each: not each.request.message.verb):
        if exchange.verb not in taken:
            found.setdefault(exchange.verb, exchange)
    return [each for each in model.exchanges if found.get(each.verb) is each]


def _examples(model: Model) -> dict[str, list[_Line]]:
    """Return the example arguments of each verb, and what they do."""
    commands, questions = _commands(model), _questions(model)
    found = {
        **{each.verb: _verb_lines(each, model) for each in messages_by_verb(model)},
        "answer": [("", "questions on standard input, until it ends")],
        "decode": _decode_lines(model),
        "docs": _docs_lines(model),
        "explain": _explain_lines(model),
        "doctor": [
            ("", "check the only port, and the device behind it"),
            ("--port COM7", "check this port"),
            ('--port COM7 --model "V1.3" --report line.hex', "a report to send in"),
            ("--port COM7 --json", "for a program to read"),
        ],
        "encode": _encode_lines(model),
        "monitor": [
            ("--port COM7", "every frame, and all noise"),
            ("--port COM7 -t delta -n 5", "five, each with the time since the one before"),
            ("--port COM7 --only noise", "only bytes that are no frame"),
            ("--port COM7 --log line.hex", "recorded for `decode`"),
            ("--port COM7 --direction any -t absolute", "both ends of a line, the time of day"),
            ("--port COM7 --hide noise --json", "messages, for a program to read"),
        ],
        "ports": [
            ("", "name, VID:PID and description of each port"),
            ("--json", "the same as lines of JSON"),
        ],
        "stats": [
            ("line.hex", "a recording: what came how often, and when"),
            ("line.bin --plot line.svg", "also a drawing of what was measured"),
            ("line.hex --from 1m30s --to 2m --ids 1,3-5", "a part of it, and of these alone"),
            ("--json line.hex", "for a program to read"),
        ],
        "simulate": [
            ("", "a device behind a port, whose name is printed first"),
            ("--help", "all its options"),
        ],
    }
    if commands or questions:
        found["send"] = [*commands[:4], *((words, about) for words, about, _ in questions)]
        found["replay"] = [
            ("line.hex --dry-run", "what would be sent, and when"),
            ("line.hex --port COM7", "the recording again"),
            ("line.hex --port COM7 --speed 0.5", "at half the speed"),
            ("line.bin --port COM7 --skip-noise", "raw bytes, without the noise"),
        ]
    if questions:
        found["bench-line"] = [
            (f"{words} -n 20" if at else words, f"how long {reply} takes to arrive")
            for at, (words, _, reply) in enumerate(questions)
        ]
    if model.spec.pose is not None:
        found["doctor"].append(("--port COM7 --move 1", "also move that id, after asking"))
        found["stop"] = [("", "everything that answers is held, the rest is named")]
        found["hold"] = [("", "all that answer"), ("1 2", "these two")]
        found["play"] = [
            ("poses.json --dry-run", "what would be sent, and when"),
            ("poses.json --port COM7", "from pose to pose, each in a second"),
            (
                "poses.json --port COM7 --time-ms 500 --pause 1 --repeat 3",
                "faster, and three times",
            ),
        ]
        found["teach"] = [
            ("poses.json --port COM7", "all ids that answer, at each Enter"),
            ("poses.json --port COM7 --ids 1-3 --append", "three ids, added to the file"),
        ]
    return found


def _verb_lines(exchange: Exchange, model: Model) -> list[_Line]:
    """Return an example of a message by its verb: values in the order of its method."""
    message = MessageView(exchange.request, model)
    fields = message.command_words(exchange.request.message.examples[0].values)
    given = dict(field.split("=", 1) for field in fields)
    lasts = exchange.lasts
    words: list[str] = []
    for name in exchange.arguments:
        if name in given and (lasts is None or name != lasts.name):
            field = next(each for each in exchange.request.arguments if each.name == name)
            words += given[name].split(",") if isinstance(field, Items) else [given[name]]
    if lasts is not None and lasts.name in given:
        whole = given[lasts.name].removesuffix("000") if lasts.field.unit == "ms" else ""
        is_whole = whole != given[lasts.name] and whole
        words += ["--in", f"{whole}s" if is_whole else f"{given[lasts.name]}{lasts.field.unit}"]
    return [(" ".join(words), exchange.request.message.summary)]


def _decode_lines(model: Model) -> list[_Line]:
    """Return the ways to pass bytes."""
    frame = _messages(model)[0].example.hex
    return [
        (frame.hex(" ").upper(), "bytes in hex, in any notation"),
        ("line.bin", "a recording, hex or raw bytes"),
        (f"--direction {model.directions[0].sender} -", "what arrives on standard input"),
        ("--json line.bin", "a line of JSON for each message and noise"),
        ("-t absolute line.hex", "a recording, with the time of day"),
        ("--csv line.hex", "a row for each, for a spreadsheet"),
        ("line.bin --csv-tables tables", "a folder of CSV files, one a message"),
        ("line.bin --parquet tables", "a folder of tables, for pandas, Polars or DuckDB"),
        ("line.bin --arrow line.arrow", "all events in one table"),
    ]


def _docs_lines(model: Model) -> list[_Line]:
    """Return the ways to look something up."""
    message = _messages(model)[0]
    layout = message.layout
    numbers = [
        (f"0x{number:0{2 * part.size}X}", f"the messages with this {part.name}")
        for part, number in zip(layout.frame.ids, layout.ids, strict=True)
        if len(layout.ids) == 1
    ]
    return [
        ("", "every message, in a line"),
        (message.name, "a message: its bytes, fields and examples"),
        *numbers,
        (snake_case(message.name).split("_")[0], "whatever has this in its name or its text"),
        ("errata", "where the documents are wrong, and what they leave open"),
        ("lookalikes", "protocols that are easily taken for this one"),
    ]


def _explain_lines(model: Model) -> list[_Line]:
    """Return the ways to have bytes explained."""
    message = _messages(model)[0]
    frame, sender = message.example.hex, message.layout.direction.sender
    return [
        (frame.hex(" ").upper(), "each byte, and what it says"),
        (f"{frame.hex().upper()} --direction {sender}", f"as sent by the {sender} alone"),
        (frame[:-1].hex(" ").upper(), "where and why it is no frame"),
    ]


def _encode_lines(model: Model) -> list[_Line]:
    """Return an example of each shape of message."""
    shapes: dict[tuple[bool, bool], _Line] = {}
    for message in _messages(model):
        shape = bool(message.numbers), message.items is not None
        line = _words(message), message.layout.message.summary
        shapes.setdefault(shape, line)
    return [*shapes.values()]


def _commands(model: Model) -> list[_Line]:
    """Return an example of each message of the client without a reply, and what it does."""
    return [
        (f"--port COM7 {_words(message)}", message.layout.message.summary)
        for exchange, message in _sent(model)
        if exchange.reply is None
    ]


def _questions(model: Model) -> list[tuple[str, str, str]]:
    """Return an example of each query, what it does, and its reply."""
    return [
        (f"--port COM7 {_words(message)}", message.layout.message.summary, exchange.reply.name)
        for exchange, message in _sent(model)
        if exchange.reply is not None
    ]


def _sent(model: Model) -> list[tuple[Exchange, MessageView]]:
    return [(each, MessageView(each.request, model)) for each in model.exchanges]


def _words(message: MessageView) -> str:
    """Return a message as the command accepts it, with the values of its example."""
    return " ".join([message.name, *message.command_words(message.example.values)])


def _messages(model: Model) -> list[MessageView]:
    return [MessageView(message, model) for message in model.messages.values()]


def _pairs(examples: Iterable[_Line]) -> list[Bracketed]:
    return [
        Bracketed("(", [Text(line, item=True), Text(what, item=True)], ")")
        for line, what in examples
    ]
