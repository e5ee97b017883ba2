"""Write noisy_line.bin, one session of both directions on one line, and noisy_line.md beside it.

Run it without arguments.  Every byte is a literal below and nothing is drawn at random, so the
two files come out the same everywhere.  The session is made up, but nothing in it is far-fetched:
the frames are those of the protocol document, what is known of boards in the field, and the
mistakes that people make.
"""

from pathlib import Path
from typing import NamedTuple

HOST, CONTROLLER, LINE = "host", "controller", "line"


class Event(NamedTuple):
    """Bytes that came onto the line together, and their correct decoding."""

    sender: str
    hex: str
    story: str
    reads_as: str
    """What its bytes belong to when either side may have sent them, in order.

    A frame that is legal both ways is named as the host's.  Two names where the bytes fall
    apart; the name of the event before where that one swallows their beginning.
    """

    @property
    def data(self) -> bytes:
        """The bytes themselves."""
        return bytes.fromhex(self.hex)


class Chapter(NamedTuple):
    """A stretch of the session with one subject."""

    title: str
    events: tuple[Event, ...]


# The board gets its power.  Whatever its UART does before the firmware runs is noise, and the last
# byte of it is a 55 that looks like the beginning of the header which follows.
POWER_UP = Chapter(
    "Power-up",
    (
        Event(LINE, "00", "the line is held low while the supply rises", "noise"),
        Event(LINE, "FF FE F8", "and rings when it is let go", "noise"),
        Event(LINE, "55", "one stray 55, right before a header", "noise"),
        Event(
            HOST, "55 55 02 0F", "how is the battery? (document, 1.5 request)", "BatteryVoltageRead"
        ),
        Event(CONTROLLER, "55 55 04 0F 4C 1D", "7500 mV (document, 1.5 reply)", "BatteryVoltage"),
    ),
)

# The moves and the position reading of the document, then the sizes that a real arm has.
FIRST_MOVES = Chapter(
    "First moves",
    (
        Event(
            HOST,
            "55 55 08 03 01 E8 03 01 20 03",
            "servo 1 to 800 in 1000 ms (document, 1.1 example 1)",
            "ServoMove",
        ),
        Event(
            HOST,
            "55 55 0B 03 02 20 03 02 20 03 09 20 03",
            "servos 2 and 9 to 800 in 800 ms (document, 1.1 example 2)",
            "ServoMove",
        ),
        Event(
            HOST,
            "55 55 14 03 05 DC 05 01 F4 01 02 F4 01 03 F4 01 04 F4 01 05 F4 01",
            "five servos to the centre in 1500 ms",
            "ServoMove",
        ),
        Event(
            HOST,
            "55 55 17 03 06 E8 03 01 F4 01 02 F4 01 03 F4 01 04 F4 01 05 F4 01 06 F4 01",
            "six servos to the centre in 1000 ms",
            "ServoMove",
        ),
        Event(
            HOST,
            "55 55 09 15 06 01 02 03 04 05 06",
            "where are servos 1 to 6? (document, 1.7 request)",
            "ServoPositionsRead",
        ),
        Event(
            CONTROLLER,
            "55 55 15 15 06 01 F4 01 02 F4 01 03 F4 01 04 F4 01 05 F4 01 06 F4 01",
            "all at 500 (document, 1.7 reply)",
            "ServoPositions",
        ),
        Event(HOST, "55 55 05 15 02 01 02", "where are servos 1 and 2?", "ServoPositionsRead"),
        Event(CONTROLLER, "55 55 09 15 02 01 F4 01 02 0A 02", "at 500 and 522", "ServoPositions"),
    ),
)

# Reports come when the controller has something to report, not when the host expects them: twice
# here they stand between a request and its reply.  RUN and its report, STOP and its report are
# the same bytes, and without a direction both read as the host's.
ACTION_GROUPS = Chapter(
    "Action groups, and unsolicited reports",
    (
        Event(
            HOST,
            "55 55 05 06 08 01 00",
            "run group 8 once (document, 1.2 example 1)",
            "ActionGroupRun",
        ),
        Event(
            CONTROLLER,
            "55 55 05 06 08 01 00",
            "group 8 has started, once (document, 2.1)",
            "ActionGroupRun",
        ),
        Event(HOST, "55 55 02 0F", "how is the battery?", "BatteryVoltageRead"),
        Event(
            CONTROLLER,
            "55 55 05 08 08 01 00",
            "group 8 ends by itself before the reply; taken for the reply it would be 264 mV",
            "ActionGroupCompleted",
        ),
        Event(
            CONTROLLER,
            "55 55 04 0F C9 1E",
            "7881 mV, as captured from a real board",
            "BatteryVoltage",
        ),
        Event(
            HOST,
            "55 55 05 06 02 00 00",
            "run group 2 without end (document, 1.2 example 2)",
            "ActionGroupRun",
        ),
        Event(
            CONTROLLER, "55 55 05 06 02 00 00", "group 2 has started, without end", "ActionGroupRun"
        ),
        Event(
            HOST,
            "55 55 05 0B 08 32 00",
            "group 8 at half its speed (document, 1.4 example 1)",
            "ActionGroupSpeed",
        ),
        Event(
            HOST,
            "55 55 05 0B FF 2C 01",
            "all groups at 300 % (document, 1.4 example 2)",
            "ActionGroupSpeed",
        ),
        Event(HOST, "55 55 04 15 01 03", "where is servo 3?", "ServoPositionsRead"),
        Event(
            CONTROLLER,
            "55 55 02 07",
            "somebody with the wireless handle stops group 2",
            "ActionGroupStop",
        ),
        Event(
            CONTROLLER,
            "55 55 05 06 04 03 00",
            "and starts group 4, three times",
            "ActionGroupRun",
        ),
        Event(CONTROLLER, "55 55 06 15 01 03 20 03", "servo 3 is at 800", "ServoPositions"),
        Event(HOST, "55 55 02 07", "stop (document, 1.3)", "ActionGroupStop"),
        Event(CONTROLLER, "55 55 02 07", "group 4 was stopped", "ActionGroupStop"),
    ),
)

# A limp arm gives odd positions, and an odd servo id gives a frame that ends in 55.
LETTING_GO = Chapter(
    "Letting go",
    (
        Event(
            HOST,
            "55 55 06 14 03 01 02 03",
            "unload servos 1 to 3 (document, 1.6 example 1)",
            "ServoUnload",
        ),
        Event(
            HOST,
            "55 55 09 14 06 01 02 03 04 05 06",
            "unload servos 1 to 6 (document, 1.6 example 2, whose prose says five)",
            "ServoUnload",
        ),
        Event(
            HOST,
            "55 55 09 15 06 01 02 03 04 05 06",
            "where are servos 1 to 6?",
            "ServoPositionsRead",
        ),
        Event(
            CONTROLLER,
            "55 55 0F 15 04 01 F4 01 02 E7 01 04 FF FF 06 FB FF",
            "four of six answer: 4 is off (65535), 6 sags below zero (65531), 3 and 5 are left out",
            "ServoPositions",
        ),
        Event(
            HOST,
            "55 55 04 15 01 55",
            "where is servo 85? The frame ends in 55, and a header follows at once",
            "ServoPositionsRead",
        ),
        Event(CONTROLLER, "55 55 03 15 00", "there is none: no positions", "ServoPositions"),
        Event(
            HOST,
            "55 55 0B 03 02 E8 03 55 55 02 07 F4 01",
            "servo 85 to 597, servo 7 to 500; the four bytes of a STOP stand inside, and are none",
            "ServoMove",
        ),
    ),
)

# Eighteen servos.  The request begins with the very four bytes with which a reply for six begins.
HUMANOID = Chapter(
    "A humanoid on the same line",
    (
        Event(
            HOST,
            "55 55 3B 03 12 D0 07"
            " 01 F4 01 02 90 01 03 58 02 04 F4 01 05 64 00 06 84 03"
            " 07 F4 01 08 90 01 09 58 02 0A F4 01 0B 64 00 0C 84 03"
            " 0D F4 01 0E 90 01 0F 58 02 10 F4 01 11 64 00 12 84 03",
            "eighteen servos in 2000 ms, 61 bytes",
            "ServoMove",
        ),
        Event(
            HOST,
            "55 55 15 15 12 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F 10 11 12",
            "where are all eighteen?",
            "ServoPositionsRead",
        ),
        Event(
            CONTROLLER,
            "55 55 39 15 12"
            " 01 F2 01 02 91 01 03 57 02 04 F4 01 05 66 00 06 81 03"
            " 07 F4 01 08 90 01 09 55 02 0A F4 01 0B 64 00 0C 84 03"
            " 0D F5 01 0E 8E 01 0F 58 02 10 F3 01 11 63 00 12 85 03",
            "nearly where they were sent, 59 bytes",
            "ServoPositions",
        ),
    ),
)

# There is no checksum.  What protects the frames behind a false header is that its length, its
# command or its count is impossible, and that its length is never believed.
INTERFERENCE = Chapter(
    "Interference",
    (
        Event(LINE, "00 C0 00 13", "a motor starts", "noise"),
        Event(LINE, "55", "a stray 55 before a move of one servo", "noise"),
        Event(HOST, "55 55 08 03 01 E8 03 02 F4 01", "servo 2 to 500 in 1000 ms", "ServoMove"),
        Event(
            LINE,
            "55",
            "a stray 55 before a move of five: length 85, command 20, all but a legal UNLOAD",
            "noise",
        ),
        Event(
            HOST,
            "55 55 14 03 05 E8 03 01 BC 02 02 2C 01 03 F4 01 04 BC 02 05 2C 01",
            "five servos in 1000 ms",
            "ServoMove",
        ),
        Event(LINE, "55 55", "a whole stray header", "noise"),
        Event(HOST, "55 55 02 07", "stop; nothing was running, so no report", "ActionGroupStop"),
        Event(LINE, "55 55 FF", "a false header that claims 254 bytes more", "noise"),
        Event(HOST, "55 55 02 07", "stop, and it must be received", "ActionGroupStop"),
        Event(LINE, "55 55 40", "a false header with the length of an UNLOAD of 61", "noise"),
        Event(HOST, "55 55 02 0F", "how is the battery?", "BatteryVoltageRead"),
        Event(CONTROLLER, "55 55 04 0F EE 1D", "7662 mV", "BatteryVoltage"),
        Event(HOST, "55 55 02 0F", "and now?", "BatteryVoltageRead"),
        Event(CONTROLLER, "55 D5 04 0F FD 1D", "7677 mV, but a bit of the header flipped", "noise"),
        Event(HOST, "55 55 02 0F", "once more", "BatteryVoltageRead"),
        Event(CONTROLLER, "55 55 04 0F FD 1D", "7677 mV", "BatteryVoltage"),
    ),
)

# Hand-written encoders mostly get the length wrong.
WRONG_LENGTHS = Chapter(
    "Hand-written frames",
    (
        Event(
            HOST,
            "55 55 07 03 01 E8 03 01 20 03",
            "the first example with a length one too small",
            "noise",
        ),
        Event(
            HOST,
            "55 55 09 03 01 E8 03 01 20 03",
            "no better one too large",
            "noise",
        ),
        Event(HOST, "55 55 08 03 01 E8 03 01 20 03", "right at last", "ServoMove"),
        Event(
            HOST,
            "55 55 03 06 08 01 00",
            "the length counts the parameters only, as the document says in one place",
            "noise",
        ),
        Event(HOST, "55 55 05 06 08 01 00", "parameters plus two", "ActionGroupRun"),
        Event(CONTROLLER, "55 55 05 06 08 01 00", "group 8 has started, once", "ActionGroupRun"),
        Event(
            HOST,
            "55 55 07 14 03 01 02 03",
            "an UNLOAD one too long: the count of three betrays it",
            "noise",
        ),
        Event(
            HOST,
            "55 55 08 14 06 01 02 03 04 05",
            "an UNLOAD of five that says six, after the prose of example 2",
            "noise",
        ),
        Event(HOST, "55 55 08 14 05 01 02 03 04 05", "unload servos 1 to 5", "ServoUnload"),
        Event(CONTROLLER, "55 55 05 08 08 01 00", "group 8 ends by itself", "ActionGroupCompleted"),
    ),
)

# Frames of protocols that look alike.  One of them cannot be distinguished from ours by any reader.
LOOK_ALIKES = Chapter(
    "Other people's protocols",
    (
        Event(
            HOST,
            "55 55 01 07 01 F4 01 E8 03 16",
            "LX-16A: servo 1 to 500 in 1000 ms, checksum 16; no frame of ours has length 1",
            "noise",
        ),
        Event(HOST, "55 55 05 06 01 00 00", "run group 1 without end", "ActionGroupRun"),
        Event(CONTROLLER, "55 55 05 06 01 00 00", "group 1 has started", "ActionGroupRun"),
        Event(
            HOST,
            "55 55 02 07 01 F4 01 E8 03 15",
            "LX-16A: the same for servo 2, and its id and length are our STOP",
            "ActionGroupStop, noise",
        ),
        Event(CONTROLLER, "55 55 02 07", "so the controller stopped group 1", "ActionGroupStop"),
        Event(
            HOST,
            "55 55 02 01",
            "sibling dialect: which version? An unknown command in a frame of exact shape",
            "noise",
        ),
        Event(HOST, "55 55 02 0F", "how is the battery?", "BatteryVoltageRead"),
        Event(
            CONTROLLER,
            "55 55 0E 0D F4 01 F4 01 2C 01 F4 01 BC 02 F4 01",
            "sibling dialect: an unknown command with twelve parameters",
            "noise",
        ),
        Event(CONTROLLER, "55 55 04 0F C9 1E", "7881 mV", "BatteryVoltage"),
        Event(
            CONTROLLER,
            "55 55 02 06",
            "sibling dialect: RUN acknowledged with length 2; a known command, a wrong length",
            "noise",
        ),
        Event(HOST, "55 55 02 0F", "and now?", "BatteryVoltageRead"),
        Event(CONTROLLER, "55 55 04 0F C9 1E", "7881 mV", "BatteryVoltage"),
    ),
)

# A frame that was cut short is refused when its next byte is impossible.  When none is, it eats
# what comes next, and a reader without a clock can do nothing about it.
CUT_SHORT = Chapter(
    "Frames cut short",
    (
        Event(HOST, "55 55 0B 03", "a move of two, cut before its count", "noise"),
        Event(
            HOST,
            "55 55 02 0F",
            "how is the battery? A count of 85 is impossible above, so this frame is saved",
            "BatteryVoltageRead",
        ),
        Event(CONTROLLER, "55 55 04 0F EE 1D", "7662 mV", "BatteryVoltage"),
        Event(HOST, "55 55 08 03 01 E8 03", "a move of one, cut before its target", "ServoMove"),
        Event(
            HOST,
            "55 55 04 15 01 01",
            "where is servo 1? Its first three bytes become the target above: servo 85 to 1109",
            "ServoMove, noise",
        ),
        Event(
            HOST,
            "55 55 04 15 01 01",
            "no answer, so the host asks again",
            "ServoPositionsRead",
        ),
        Event(CONTROLLER, "55 55 06 15 01 01 F4 01", "servo 1 is at 500", "ServoPositions"),
    ),
)

# The reply claims 23 bytes and 17 come.  Until the line is known to be quiet a decoder has to
# hold them all, the STOP among them; then it must find it.
BROKEN_TAIL = Chapter(
    "The plug is pulled",
    (
        Event(
            HOST,
            "55 55 09 15 06 01 02 03 04 05 06",
            "where are servos 1 to 6?",
            "ServoPositionsRead",
        ),
        Event(
            CONTROLLER,
            "55 55 15 15 06 01 F4 01 02 F4 01",
            "the reply breaks off after two servos",
            "noise",
        ),
        Event(HOST, "55 55 02 07", "stop: found only once the line is quiet", "ActionGroupStop"),
        Event(HOST, "55 55", "a header, and the recording ends", "noise"),
    ),
)

CHAPTERS = (
    POWER_UP,
    FIRST_MOVES,
    ACTION_GROUPS,
    LETTING_GO,
    HUMANOID,
    INTERFERENCE,
    WRONG_LENGTHS,
    LOOK_ALIKES,
    CUT_SHORT,
    BROKEN_TAIL,
)
EVENTS = tuple(event for chapter in CHAPTERS for event in chapter.events)


def recording() -> bytes:
    """Return the bytes of all events in order, as the recorder saw them."""
    return b"".join(event.data for event in EVENTS)


def description() -> str:
    """Return the tables that describe the recording."""
    lines = [
        "# What noisy_line.bin holds",
        "",
        "Written by `make_noisy_line.py`; change the script and run it again.",
        "",
        f"{len(EVENTS)} events, {len(recording())} bytes: both directions of one session, in the",
        "order in which the bytes came, without times. The session is made up; its frames are",
        "those of the protocol document, of boards in the field, and of people's mistakes.",
        "",
        "*Reads as* is what the bytes belong to when either side may have sent them and the line",
        "goes quiet after the last byte. A frame that is legal both ways (a group run and the",
        "report of its start, a stop and its report) is named as the host's. Two names: the bytes",
        "fall apart, or the event before has swallowed their beginning.",
    ]
    number = offset = 0
    for chapter in CHAPTERS:
        lines += [
            "",
            f"## {chapter.title}",
            "",
            "| # | offset | sender | bytes | what happened | reads as |",
            "|--:|-------:|--------|-------|---------------|----------|",
        ]
        for event in chapter.events:
            number += 1
            shown = event.data.hex(" ").upper()
            lines.append(
                f"| {number} | {offset} | {event.sender} | `{shown}` | {event.story} "
                f"| {event.reads_as} |"
            )
            offset += len(event.data)
    return "\n".join(lines) + "\n"


def main() -> None:
    """Write both files beside this script."""
    here = Path(__file__).parent
    (here / "noisy_line.bin").write_bytes(recording())
    (here / "noisy_line.md").write_text(description(), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
