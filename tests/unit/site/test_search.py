"""The search: what words, numbers and bytes find in the site of this project, best first."""

import re
from functools import cache
from subprocess import Popen
from typing import Any

import pytest
from framegen.render import snippets
from framegen.site.project import Project, read_project
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.search.entry import KINDS, Entry, spellings
from framegen.site.search.words import with_words
from framegen.site.site import Site

from tests.factories import compiled_file
from tests.unit.site.lamps import lamps
from tests.unit.site.reference import NODE, ROOT
from tests.unit.site.scripts import node, run_script

# What a page of the search runs, without what touches the page.
RANKING = ["matching", "ranking", "snippet"]

needs_node = pytest.mark.skipif(NODE is None, reason="node is not installed")


@cache
def project() -> Project:
    files = [ROOT / "spec" / f"{name}.yaml" for name in ("busservo", "lxservo")]
    return read_project({file: compiled_file(file) for file in files}, ROOT / "docs")


@cache
def index() -> Any:
    return Site(project(), snippets()).search.data


@cache
def told(_process: Popen[str]) -> None:
    """Keep the searches of this site for the programs that follow in a process."""
    scripts = [*codec_scripts(project().specs[1].model), *RANKING, "bytes_found"]
    program = """
    Object.assign(kept, { bytesIn, search: makeSearch(asked), bytes: makeBytesSearch(asked) });
    const answers = null;
    """
    run_script(scripts, program, index())


def found(queries: list[str], filters: list[dict[str, str]] | None = None) -> Any:
    """Return what is found for each query: titles and places of hits, and what is said besides."""
    told(node())
    program = """
    const answers = asked.queries.map((query, at) => {
      const { hits, ...rest } = kept.search.find(query, asked.filters[at] ?? {});
      return { ...rest, titles: hits.map(({ entry }) => entry.title),
        wheres: hits.map(({ entry }) => entry.where), paths: hits.map(({ entry }) => entry.path) };
    });
    """
    return run_script([], program, {"queries": queries, "filters": filters or []})


# What is found first, in any order, by queries: names however they are written, numbers in decimal
# and in hex, words of users, which no page of the reference has, prose and sections.
SEARCHES = """
ServoMove < ServoMove | servomov | CMD_SERVO_MOVE | 0x03 | degrees
BatteryVoltage | BatteryVoltageRead < GET_BATTERY_VOLT
BatteryVoltageRead < battery
VoltageRead < voltageread
targets[i].position < targets.position | targets[i].position
move_servos() < move_servos | move_servos(targets
hold_servos() < hold_servos
unlimited < unlimited
ServoUnload < unload | limp | torque off
LX-16A bus servo protocol | Servos without the controller < LX-16A | lx16a
The group of ActionGroupSpeed is called the number of a servo < erratum 3
ActionGroupSpeed | MoveStart < 0x0B | 11
absent < 65535
all < 0xFF
The board beeps at a frame of mine | What the board shows < beep
Servos and supply < power supply
Hiwonder bus servo controller < baudrate | baud rate
Troubleshooting < comport | permission denied
Troubleshooting | What the board shows < LED2
Servos without the controller < echo
unsolicited reply < unsolicited reply
Asks for the version < asks for the version
ModeWrite < wheel mode
"""


def listed(table: str, mark: str) -> dict[str, str]:
    """Return what is in front of the mark in the lines of a table, by each of what is behind it."""
    lines = [line.split(mark) for line in table.strip().splitlines()]
    return {each: front for front, behind in lines for each in behind.split(" | ")}


@needs_node
def test_searches_find_first() -> None:
    searches = listed(SEARCHES, " < ")
    for (query, line), answer in zip(searches.items(), found([*searches]), strict=True):
        names = {*line.split(" | ")}
        assert set(answer["titles"][: len(names)]) == names, query
        assert not answer["loose"]


@needs_node
def test_words_that_stand_nowhere_are_said() -> None:
    queries = ["battery erratum", "which baudrate", "xyzzy", "battery xyzzy", "servo xyzzy"]
    answers = found(queries)
    assert [answer["absent"] for answer in answers] == [[], [], *[["xyzzy"]] * 3]
    both, named, neither, some, little = answers
    assert all("Erratum" in both["wheres"][at] for at in (0, 1))
    assert named["titles"][0] == "Hiwonder bus servo controller"
    assert (neither["titles"], neither["loose"]) == ([], False)
    assert some["loose"]
    assert "BatteryVoltageRead" in some["titles"]
    # "servo" stands nearly everywhere, and tells nothing.
    assert not little["titles"]


# Whether a key is a form of a word that is whole, and of one that is still being typed.
FORMS = {
    ("no", "no"): (True, True),
    ("note", "no"): (False, True),
    ("bits", "bit"): (True, True),
    ("led2", "led"): (True, True),
    ("100", "1"): (False, True),
    ("moving", "move"): (True, True),
    ("nodding", "node"): (False, False),
    ("nod", "node"): (False, False),
    ("node", "nodes"): (True, True),
    ("voltages", "volt"): (True, True),
    ("position", "positions"): (True, True),
}


@needs_node
def test_what_is_short_begins_no_longer_word_unless_it_is_the_last() -> None:
    program = (
        "const answers = asked.map(([key, word]) => [isForm(key, word), isForm(key, word, true)]);"
    )
    answers = run_script(["matching"], program, [*FORMS])
    assert dict(zip(FORMS, map(tuple, answers), strict=True)) == FORMS
    typed, done, begun = found(["no", "no battery", "bat volt"])
    assert len(typed["titles"]) > len(done["titles"]) > 0
    assert (typed["open"], done["open"]) == (["no"], ["battery"])
    # One that stands nowhere alone is a beginning after all.
    assert begun["titles"][0] == "BatteryVoltageRead"


@needs_node
def test_what_is_not_for_users_comes_behind_unless_its_headings_are_meant() -> None:
    guides = {each["path"].partition("#")[0] for each in index()["entries"] if each.get("aside")}
    assert {"testing.html", "project/benchmarks.html", "what-changes-break.html"} <= guides
    assert not guides & {"getting-started.html", "troubleshooting.html", "command.html"}
    said: dict[str, Any] = {"kind": "guide", "path": "a.html", "where": "Guide"}
    entries = [
        {**said, "title": "Peers", "text": "the buzzer", "aside": True},
        {**said, "title": "Board", "text": "the buzzer"},
        *({**said, "title": f"Other {number}"} for number in range(9)),
    ]
    data = {"entries": entries, "kinds": KINDS, "protocols": []}
    program = """
    const search = makeSearch(asked);
    const answers = ["buzzer", "peers and the buzzer"].map((query) => search.find(query).hits
      .map(({ entry }) => entry.title));
    """
    answers = run_script(RANKING, program, data)
    assert answers == [["Board", "Peers"], ["Peers", "Board"]]


@needs_node
def test_what_is_between_quotes_must_stand_there_as_it_is() -> None:
    said = "switch off the force"
    phrase, curly, words, none = found(
        [f'"{said}"', f"“{said}”", "force switch", '"force off the"']
    )
    assert phrase["titles"][0] == "ServoUnload"
    assert curly["titles"] == phrase["titles"]
    assert set(phrase["titles"]) < set(words["titles"])
    assert not none["titles"]


MISSPELLED = {
    "batery": "battery",
    "postion": "position",
    "srevo": "servo",
    "protocool": "protocol",
    "troubelshooting": "troubleshooting",
    "ActionGruopRun": "ActionGroupRun",
    "batery voltage": "battery voltage",
}


@needs_node
def test_words_with_a_slip_are_corrected() -> None:
    meant = found([*MISSPELLED.values()])
    for right, slip, answer in zip(MISSPELLED.values(), found([*MISSPELLED]), meant, strict=True):
        assert slip["suggestions"][0] == right
        assert slip["titles"] == answer["titles"] != []
        assert answer["suggestions"] == []
    # What is offered has hits, or else it is no help.
    names = [message.vendor_name for message in project().specs[0].spec.messages.values()]
    pairs = [f"batery {name}" for name in names]
    offered = [text for answer in found(pairs) for text in answer["suggestions"]]
    assert 0 < len(offered) < len(pairs)
    for answer in found(offered):
        assert answer["titles"]
        assert not answer["loose"]
    # Two slips are another word, and short words are too like each other.
    assert [each["suggestions"] for each in found(["bttry", "qzx"])] == [[], []]


@needs_node
def test_hits_are_of_the_kind_and_the_protocol_that_are_asked_for() -> None:
    filters = [{}, {"protocol": "lxservo"}, *({"kind": kind} for kind in KINDS)]
    everything, bus, *kinds = found(["servo"] * len(filters), filters)
    counts = everything["counts"]
    assert sum(counts.values()) == len(everything["titles"])
    assert [len(each["titles"]) for each in kinds] == [counts.get(kind, 0) for kind in KINDS]
    assert all(each["counts"] == counts for each in kinds)
    entries = {(each["title"], each["path"], each["where"]): each for each in index()["entries"]}
    places = zip(bus["titles"], bus["paths"], bus["wheres"], strict=True)
    assert {entries[place]["protocol"] for place in places} == {"lxservo"}


# Pieces of a text, those that match in «».
MARKED = {
    ("Ask for the battery", "battery"): "Ask for the «battery»",
    ("BatteryVoltageRead is a query", "voltage"): "«BatteryVoltageRead» is a query",
    ("time_ms, not time", "timems"): "«time_ms», not time",
    ("servos and a servo", "servos"): "«servos» and a «servo»",
    ("<b>servo</b>", "servo"): "<b>«servo»</b>",
    ("nothing", "servo"): "nothing",
    ("", "servo"): "",
    ("no note, none", "no"): "«no» note, none",
}


@needs_node
def test_words_that_match_are_marked() -> None:
    program = """
    const answers = asked.map(([text, word]) => piecesOf(text, [word])
      .map((piece) => (piece.hit ? `«${piece.text}»` : piece.text)).join(""));
    """
    assert run_script(RANKING, program, [*MARKED]) == [*MARKED.values()]


@needs_node
def test_a_snippet_shows_the_words_and_is_part_of_the_text() -> None:
    program = "const answers = asked.map(([text, words]) => snippetOf(text, words));"
    texts = [(each["text"], ["reply"]) for each in index()["entries"] if "text" in each]
    for (text, _), snippet in zip(texts, run_script(RANKING, program, texts), strict=True):
        assert len(snippet) <= 210
        assert snippet.removeprefix("… ").removesuffix(" …").strip() in text
        if "reply" in text.lower():
            assert "repl" in snippet.lower()


# ---------------------------------------------------------------------------- bytes


def bytes_found(queries: list[str]) -> Any:
    told(node())
    program = """
    const answers = asked.map((query) => {
      const read = kept.bytesIn(query);
      if (!read || !read.bytes) return { read };
      return { read: { ...read, bytes: Array.from(read.bytes) }, ...kept.bytes.find(read.bytes) };
    });
    """
    return run_script([], program, queries)


SPELLED = [
    *("55 55 02 0F", "5555020F", "0x55,0x55,0x02,0x0f", "0x55 0x55 0x2 0xF", "55-55-02-0F"),
    *(r"\x55\x55\x02\x0f", r"b'\x55\x55\x02\x0f'", 'bytes.fromhex("55 55 02 0F")'),
    *("[0x55, 0x55, 0x02, 0x0F]", "55:55:02:0f", "55h 55h 02h 0Fh"),
]


@needs_node
def test_bytes_are_read_as_people_write_them() -> None:
    for text, answer in zip(SPELLED, bytes_found(SPELLED), strict=True):
        assert answer["read"]["bytes"] == [0x55, 0x55, 0x02, 0x0F], text
        (frame,) = answer["judged"]
        assert frame["title"] == "BatteryVoltageRead"
        assert frame["path"] == "reference/busservo/messages/BatteryVoltageRead.html"
        assert frame["decoder"].startswith("reference/busservo/decoder.html?hex=5555020f")


# What may be meant as something else is not certain; None is no bytes at all.
READ = {
    **dict.fromkeys(["0F", "15", "battery", "a b", "55550 20F", "servo 1"], None),
    **dict.fromkeys(["face", "dead beef", "1000", "115200"], False),
    **dict.fromkeys(["03 01 E8", "0x03 0x01"], True),
}


@needs_node
def test_words_and_numbers_are_not_taken_for_bytes() -> None:
    read = [answer["read"] for answer in bytes_found([*READ])]
    assert dict(zip(READ, [each and each.get("certain") for each in read], strict=True)) == READ


@needs_node
def test_what_looks_like_bytes_and_is_none_is_refused_with_the_place() -> None:
    texts = ["55 55 0G 02", "[0x55, 0x55, 2, 0x0F]", "55 55 2 0F", "55 55 02 0"]
    *wrong, typing = bytes_found(texts)
    whole = "“2” is no whole number of bytes"
    assert [each["read"]["problem"] for each in wrong] == ["“0G” is no byte in hex", whole, whole]
    assert (typing["read"]["bytes"], typing["read"]["left"]) == ([0x55, 0x55, 0x02], "0")


ONE = "Servo 1 to position 800 in 1000 ms"
NO_FRAME = [
    f"No frame of the {name}" for name in ("Hiwonder bus servo controller", "LX-16A servo bus")
]
# Titles of what bytes are, and of the documented frames that hold them.
BYTES: dict[str, tuple[list[str], list[str]]] = {
    "55 55 05 06 08 01 00": (
        ["ActionGroupRun", "ActionGroupStarted"],
        ["Run action group 8 once", "Action group 8 has started, to run once"],
    ),
    "55 55 04 0F 4C 1D": (["BatteryVoltage"], ["The battery is at 7500 mV"]),
    "55 55 01 07 01 20 03 E8 03 E8": (["Move"], [f"{ONE}, sent to the servo itself"]),
    "00 55 55 02 07 55 55 02 0F": (["2 frames among these bytes"], []),
    "03 01 E8": ([], [ONE, f"{ONE}, sent to the controller"]),
    "55 55 09 03 01 E8 03 01 20 03": (NO_FRAME, []),
    "11 22 33": ([], []),
}


@needs_node
def test_bytes_find_frames() -> None:
    for (text, expected), answer in zip(BYTES.items(), bytes_found([*BYTES]), strict=True):
        titles = [[each["title"] for each in answer[key]] for key in ("judged", "known")]
        assert titles == [*expected], text


TOLD = {
    "55 55 0B 03 02 20 03 02 20 03 09 20 03": "time_ms 800 ms, targets: "
    "servo_id 2 position 800; servo_id 9 position 800",
    "55 55 06 15 01 03 FF FF": "positions: servo_id 3 position 65535 (absent)",
    "55 55 09 03 01 E8": "Length mismatch at byte 2: "
    "ServoMove has a length of 8, 11, 14 .. 254, not 9.",
    "55 55 08": "A frame may begin like this; its end is missing.",
}


@needs_node
def test_bytes_are_told_in_short() -> None:
    *answers, sibling = bytes_found([*TOLD, "55 55 02 01"])
    told = [each["judged"][0]["text"] for each in answers]
    assert dict(zip(TOLD, told, strict=True)) == TOLD
    (hinted,) = [each["text"] for each in sibling["judged"] if each["protocol"] == "busservo"]
    assert hinted.endswith("In the dialect of LeArm and uHand boards, 1 asks for the version.")


# ---------------------------------------------------------------------------- questions

# Questions, behind the pages that answer them: one of these is among the first three hits, without
# `.html`; `@` and `@@` stand for the references of busservo and lxservo, `@/` for their messages.
QUESTIONS = """
getting-started captures: how to install
getting-started: how do I install this on windows | raspberry pi | how do i wire my board
getting-started: where do I start | my first program | how to uninstall
@index: which baud rate
@index getting-started: what is busservo
getting-started test-your-robot: can I try it without hardware
test-your-robot getting-started: is there a simulator
getting-started troubleshooting: which port is my board on
troubleshooting: my reply is wrong | arm does not move | my servo moves to the wrong position
troubleshooting: permission denied when I open the port
troubleshooting lx16a: why is there no answer from the board
troubleshooting getting-started: the board beeps, what does it mean
troubleshooting @/ActionGroupStop @@/MoveStop: how do I stop the arm
@/ServoMove talk-to-the-board: how do I move two servos at the same time
@/ServoPositionsRead @@/PositionRead: read the position of my servo
@/ServoUnload: how to make the servo limp
talk-to-the-board: how do I know that the move is finished
@@/ServoIdWrite lx16a: change the id of a servo
@/BatteryVoltageRead @/BatteryVoltage: is my battery low
@/BatteryVoltageRead @/BatteryVoltage @@/Voltage @@/VoltageRead: what voltage is my batery
@@/TemperatureLimitWrite: my servo gets too hot
command: play back recorded poses | log the traffic
@lookalikes troubleshooting: Arduino | is this the right protocol for my arm
getting-started troubleshooting talk-to-the-board: usb hid
lx16a: run several servos on one wire without a controller
@/ServoPositions: position reply layout
@/BatteryVoltage: battery reply bytes
@/ServoMove: move command format
@index @stream write-a-spec design: what does the length byte count
@errata @index what-changes-break: is it little endian
@@index @@stream @stream write-a-spec: how is the checksum calculated
@index @cheatsheet: list of all commands
@cheatsheet @@cheatsheet: cheatsheet
@decoder @@decoder command codec: decode my bytes
@stream design: how do I resync after garbage
@errata: error in the vendor documentation
conformance: conformance | test my own implementation
codec @stream: parse a stream of bytes
captures: plot a capture | pandas dataframe
command captures @decoder: export to csv
changing-the-protocol: how to add a command | rename a field
what-changes-break changing-the-protocol: is this a breaking change
project/contributing: how do I contribute
project/benchmarks captures: how fast is it
project/changelog @changelog: what is new
write-a-spec: describe my own protocol
publish: publish docs | github pages | where can I host the docs | hosting
project/contributing write-a-spec what-changes-break: licence
guess-a-spec: guess the protocol from a recording
"""


def pages_of(answers: str) -> list[str]:
    full = re.sub("(@+)/", r"\1messages/", answers)
    full = full.replace("@@", "reference/lxservo/").replace("@", "reference/busservo/")
    return [f"{page}.html" for page in full.split()]


@needs_node
def test_questions_lead_to_a_page_that_answers_them() -> None:
    failed = []
    questions = listed(QUESTIONS, ": ")
    for (question, answers), answer in zip(questions.items(), found([*questions]), strict=True):
        first = [path.partition("#")[0] for path in answer["paths"][:3]]
        if not set(first) & {*pages_of(answers)}:
            failed.append(f"{question}: {answers}, not {answer['titles'][:3]} at {first}")
    assert not failed, f"{len(failed)} of {len(questions)}:\n" + "\n".join(failed)


# ---------------------------------------------------------------------------- the index


def test_words_of_users_lead_to_the_first_entry_at_an_address() -> None:
    entries = index()["entries"]
    led = {word: each["path"] for each in entries for word in each.get("also", [])}
    assert {
        "limp": "reference/busservo/messages/ServoUnload.html",
        "blink": "troubleshooting.html",
        "beep": "troubleshooting.html#the-board-beeps-at-a-frame-of-mine",
        "dialout": "troubleshooting.html",
    }.items() <= led.items()
    text = (ROOT / "docs" / "words.md").read_text("utf-8")
    rows = re.findall(r"^\| (.+?) \|", text, re.MULTILINE)
    words = {word.strip() for row in rows for word in row.split(",")} - {"People say", "---"}
    assert led.keys() == words
    assert len(words) > 100


def test_words_that_lead_where_no_entry_is_make_one() -> None:
    guide = next(each for each in Site(project(), snippets()).guides if each.path == "words.md")
    known = Entry("guide", "Troubleshooting", "troubleshooting.html", "Guide")
    made = [*with_words([known], guide)]
    assert "blink" in made[0].also
    (move,) = [each for each in made if each.path.endswith("/ServoMove.html")]
    assert (move.kind, move.title) == ("page", "ServoMove")


def test_numbers_are_found_as_people_write_them() -> None:
    assert spellings(15) == ("15", "0f", "0x0f", "0xf")
    assert spellings(258, 2) == ("258", "0102", "0x0102", "0x102")
    assert spellings(-1) == ("-1",)


def test_the_search_alone_has_the_index() -> None:
    """As in the whole site: tests/world/test_search_of_the_site.py."""
    for path, page in lamps().items():
        assert ('id="search-index"' in page.text) == (path == "search.html"), path
        above = "../" * path.count("/")
        assert path == "search.html" or f'data-address="{above}search.html"' in page.text, path
