"""The search: what words, numbers and bytes find in the site of this project, best first."""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING, Any

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

if TYPE_CHECKING:
    from subprocess import Popen

# What a page of the search runs, without what touches the page.
RANKING = ["matching", "ranking", "snippet"]

needs_node = pytest.mark.skipif(NODE is None, reason="node is not installed")


@cache
def project() -> Project:
    files = [ROOT / "spec" / f"{name}.yaml" for name in ("busservo", "lxservo")]
    return read_project({file: compiled_file(file) for file in files}, ROOT / "docs")


@cache
def index() -> dict[str, Any]:
    data: dict[str, Any] = Site(project(), snippets()).search.data
    return data


@cache
def told(_process: Popen[str]) -> None:
    """Keep the searches of this site for the programs that follow in a process."""
    scripts = [*codec_scripts(project().specs[1].model), *RANKING, "bytes_found"]
    program = """
    Object.assign(kept, { bytesIn, search: makeSearch(asked), bytes: makeBytesSearch(asked) });
    const answers = null;
    """
    run_script(scripts, program, index())


def found(queries: list[str], filters: list[dict[str, str]] | None = None) -> list[dict[str, Any]]:
    """Return what is found for each query: titles and places of hits, and what is said besides."""
    told(node())
    program = """
    const answers = asked.queries.map((query, at) => {
      const { hits, ...rest } = kept.search.find(query, asked.filters[at] ?? {});
      return { ...rest, titles: hits.map(({ entry }) => entry.title),
        wheres: hits.map(({ entry }) => entry.where), paths: hits.map(({ entry }) => entry.path) };
    });
    """
    asked = {"queries": queries, "filters": filters or []}
    answers: list[dict[str, Any]] = run_script([], program, asked)
    return answers


# What is found first, by query; where several are named, these, in any order.
SEARCHES: dict[str, set[str]] = {
    # Names, whole and in parts, however they are written.
    "ServoMove": {"ServoMove"},
    "servomov": {"ServoMove"},
    "CMD_SERVO_MOVE": {"ServoMove"},
    "GET_BATTERY_VOLT": {"BatteryVoltageRead", "BatteryVoltage"},
    "battery": {"BatteryVoltageRead"},
    "voltageread": {"VoltageRead"},
    "targets.position": {"targets[i].position"},
    "targets[i].position": {"targets[i].position"},
    "move_servos": {"move_servos()"},
    "move_servos(targets": {"move_servos()"},
    "hold_servos": {"hold_servos()"},
    "unlimited": {"unlimited"},
    "unload": {"ServoUnload"},
    "LX-16A": {"Servos without the controller", "LX-16A bus servo protocol"},
    "lx16a": {"Servos without the controller", "LX-16A bus servo protocol"},
    "erratum 3": {"The group of ActionGroupSpeed is called the number of a servo"},
    # Numbers, in decimal and in hex.
    "0x03": {"ServoMove"},
    "0x0B": {"ActionGroupSpeed", "MoveStart"},
    "11": {"ActionGroupSpeed", "MoveStart"},
    "65535": {"absent"},
    "0xFF": {"all"},
    # The words of users, which no page of the reference has.
    "limp": {"ServoUnload"},
    "torque off": {"ServoUnload"},
    "beep": {"What the board shows", "The board beeps at a frame of mine"},
    "power supply": {"Servos and supply"},
    "baudrate": {"Hiwonder bus servo controller"},
    "comport": {"Troubleshooting"},
    "LED2": {"What the board shows", "Troubleshooting"},
    "permission denied": {"Troubleshooting"},
    "echo": {"Servos without the controller"},
    "baud rate": {"Hiwonder bus servo controller"},
    "degrees": {"ServoMove"},
    # Prose, sections and the glossary.
    "unsolicited reply": {"unsolicited reply"},
    "asks for the version": {"Asks for the version"},
    "wheel mode": {"ModeWrite"},
}


@needs_node
def test_searches_find_first() -> None:
    for (query, names), answer in zip(SEARCHES.items(), found([*SEARCHES]), strict=True):
        assert set(answer["titles"][: len(names)]) == names, query
        assert not answer["loose"]


@needs_node
def test_words_that_stand_nowhere_are_said() -> None:
    queries = ["battery erratum", "xyzzy", "battery xyzzy", "servo xyzzy", "which baudrate"]
    both, neither, some, little, named = found(queries)
    assert [answer["absent"] for answer in (both, named)] == [[], []]
    for answer in (neither, some, little):
        assert answer["absent"] == ["xyzzy"]
    assert both["titles"]
    assert all("Erratum" in where for where in both["wheres"][:2])
    assert not neither["titles"]
    assert not neither["loose"]
    assert some["loose"]
    assert "BatteryVoltageRead" in some["titles"]
    # "servo" stands nearly everywhere, and tells nothing.
    assert not little["titles"]
    assert named["titles"][0] == "Hiwonder bus servo controller"


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
    program = """
    const answers = asked.map(([key, word]) => [isForm(key, word), isForm(key, word, true)]);
    """
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
    phrase, curly, words, none = found(
        ['"switch off the force"', "“switch off the force”", "force switch", '"force off the"']
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
    assert sum(everything["counts"].values()) == len(everything["titles"])
    entries = {(each["title"], each["path"], each["where"]): each for each in index()["entries"]}
    for kind, answer in zip(KINDS, kinds, strict=True):
        assert len(answer["titles"]) == everything["counts"].get(kind, 0)
        assert answer["counts"] == everything["counts"]
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


def bytes_found(queries: list[str]) -> list[dict[str, Any]]:
    told(node())
    program = """
    const answers = asked.map((query) => {
      const read = kept.bytesIn(query);
      if (!read || !read.bytes) return { read };
      return { read: { ...read, bytes: Array.from(read.bytes) }, ...kept.bytes.find(read.bytes) };
    });
    """
    answers: list[dict[str, Any]] = run_script([], program, queries)
    return answers


SPELLED = [
    "55 55 02 0F",
    "5555020F",
    "0x55,0x55,0x02,0x0f",
    "0x55 0x55 0x2 0xF",
    r"\x55\x55\x02\x0f",
    r"b'\x55\x55\x02\x0f'",
    'bytes.fromhex("55 55 02 0F")',
    "[0x55, 0x55, 0x02, 0x0F]",
    "55-55-02-0F",
    "55:55:02:0f",
    "55h 55h 02h 0Fh",
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
    "0F": None,
    "15": None,
    "battery": None,
    "a b": None,
    "55550 20F": None,
    "servo 1": None,
    "face": False,
    "dead beef": False,
    "1000": False,
    "115200": False,
    "03 01 E8": True,
    "0x03 0x01": True,
}


@needs_node
def test_words_and_numbers_are_not_taken_for_bytes() -> None:
    for (text, certain), answer in zip(READ.items(), bytes_found([*READ]), strict=True):
        read = answer["read"]
        assert (None if read is None else read.get("certain")) == certain, text


@needs_node
def test_what_looks_like_bytes_and_is_none_is_refused_with_the_place() -> None:
    wrong = bytes_found(["55 55 0G 02", "[0x55, 0x55, 2, 0x0F]", "55 55 2 0F"])
    assert [each["read"] for each in wrong] == [
        {"problem": "“0G” is no byte in hex"},
        {"problem": "“2” is no whole number of bytes"},
        {"problem": "“2” is no whole number of bytes"},
    ]
    (typing,) = bytes_found(["55 55 02 0"])
    assert (typing["read"]["bytes"], typing["read"]["left"]) == ([0x55, 0x55, 0x02], "0")


# Titles of what bytes are, and of the documented frames that hold them.
BYTES: dict[str, tuple[list[str], list[str]]] = {
    "55 55 05 06 08 01 00": (
        ["ActionGroupRun", "ActionGroupStarted"],
        ["Run action group 8 once", "Action group 8 has started, to run once"],
    ),
    "55 55 04 0F 4C 1D": (["BatteryVoltage"], ["The battery is at 7500 mV"]),
    "55 55 01 07 01 20 03 E8 03 E8": (
        ["Move"],
        ["Servo 1 to position 800 in 1000 ms, sent to the servo itself"],
    ),
    "00 55 55 02 07 55 55 02 0F": (["2 frames among these bytes"], []),
    "03 01 E8": (
        [],
        [
            "Servo 1 to position 800 in 1000 ms",
            "Servo 1 to position 800 in 1000 ms, sent to the controller",
        ],
    ),
    "55 55 09 03 01 E8 03 01 20 03": (
        ["No frame of the Hiwonder bus servo controller", "No frame of the LX-16A servo bus"],
        [],
    ),
    "11 22 33": ([], []),
}


@needs_node
def test_bytes_find_frames() -> None:
    for (text, (judged, known)), answer in zip(BYTES.items(), bytes_found([*BYTES]), strict=True):
        assert [each["title"] for each in answer["judged"]] == judged, text
        assert [each["title"] for each in answer["known"]] == known, text


@needs_node
def test_bytes_are_told_in_short() -> None:
    move, off, refused, sibling, begun = bytes_found(
        [
            "55 55 0B 03 02 20 03 02 20 03 09 20 03",
            "55 55 06 15 01 03 FF FF",
            "55 55 09 03 01 E8",
            "55 55 02 01",
            "55 55 08",
        ]
    )
    assert move["judged"][0]["text"] == (
        "time_ms 800 ms, targets: servo_id 2 position 800; servo_id 9 position 800"
    )
    assert off["judged"][0]["text"] == "positions: servo_id 3 position 65535 (absent)"
    assert refused["judged"][0]["text"] == (
        "Length mismatch at byte 2: ServoMove has a length of 8, 11, 14 .. 254, not 9."
    )
    (hinted,) = [each for each in sibling["judged"] if each["protocol"] == "busservo"]
    assert hinted["text"].endswith(
        "In the dialect of LeArm and uHand boards, 1 asks for the version."
    )
    assert begun["judged"][0]["text"] == "A frame may begin like this; its end is missing."


@needs_node
def test_every_documented_frame_is_found_by_its_bytes() -> None:
    documented = [each for each in index()["entries"] if "hex" in each]
    answers = bytes_found([each["hex"] for each in documented])
    for entry, answer in zip(documented, answers, strict=True):
        assert entry["title"] in [each["title"] for each in answer["known"]]
        if entry["where"].startswith("Documented frame of "):
            name = entry["where"].removeprefix("Documented frame of ")
            assert name in [each["title"] for each in answer["judged"]], entry["hex"]


# ---------------------------------------------------------------------------- the index


def test_words_of_users_lead_to_the_first_entry_at_an_address() -> None:
    entries = index()["entries"]
    led = {word: each["path"] for each in entries for word in each.get("also", [])}
    assert led["limp"] == "reference/busservo/messages/ServoUnload.html"
    assert led["blink"] == "troubleshooting.html"
    assert led["beep"] == "troubleshooting.html#the-board-beeps-at-a-frame-of-mine"
    assert led["dialout"] == "troubleshooting.html"
    rows = re.findall(
        r"^\| (.+?) \|", (ROOT / "docs" / "words.md").read_text("utf-8"), re.MULTILINE
    )
    words = {word.strip() for row in rows for word in row.split(",")} - {"People say", "---"}
    assert led.keys() == words
    assert len(words) > 100


def test_words_that_lead_where_no_entry_is_make_one() -> None:
    guide = next(each for each in Site(project(), snippets()).guides if each.path == "words.md")
    made = list(
        with_words([Entry("guide", "Troubleshooting", "troubleshooting.html", "Guide")], guide)
    )
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
