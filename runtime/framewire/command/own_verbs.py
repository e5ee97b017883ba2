"""The verbs that a command has besides those of its messages: what they are for, and examples.

Some need what not every protocol has: `poses` to read and to command, `requests` that its client
sends, `queries` among them, or the `number` of a message.
"""

from __future__ import annotations

# A verb, what it needs, and what it is for; of two rows of a verb, the last that is met counts. In
# the order of a day's work: what programs call is last. Verbs chosen for messages stand between.
FIRST = (
    ("ports", "", "List the serial ports, and devices that have none."),
    ("doctor", "", "Diagnose a port, a line or a device."),
)
OTHERS = (
    ("stop", "poses", "Stop: hold everything where it is."),
    ("hold", "poses", "Hold what moves or is limp, where it is."),
    ("monitor", "", "Show the traffic of a line as it arrives."),
    ("teach", "poses", "Switch the device off, and record poses set by hand."),
    ("play", "poses", "Play recorded poses."),
    ("decode", "", "Decode bytes: messages, and noise with the reason."),
    ("explain", "", "Take a frame apart byte by byte, or show where and why bytes are no frame."),
    ("docs", "", "Look up a message: its bytes, fields and examples, and what is known of it."),
    ("encode", "", "Make the frame of a message."),
    ("send", "requests", "Send a message to a port."),
    ("send", "queries", "Send a message to a port, and print the reply."),
    ("stats", "", "Show what a line carried: counts, rates, gaps, noise and values."),
    ("replay", "requests", "Send a recording again."),
    ("simulate", "", "Run a virtual device to talk to."),
    ("answer", "", "Answer questions on standard input: a codec for programs in any language."),
    (
        "bench-line",
        "queries",
        "Measure how long queries take on a line, compared with what it allows.",
    ),
)
# A verb, what the example needs, its arguments, and what it does. In braces is what the library
# gives as `in_examples`; `joined` is its frame without blanks, and `cut` without the last byte.
EXAMPLES = (
    ("ports", "", "", "name, VID:PID and description of each port"),
    ("ports", "", "--json", "the same as lines of JSON"),
    ("doctor", "", "", "check the only port, and the device behind it"),
    ("doctor", "", "--port COM7", "check this port"),
    ("doctor", "", '--port COM7 --model "V1.3" --report line.hex', "a report to send in"),
    ("doctor", "", "--port COM7 --json", "for a program to read"),
    ("doctor", "poses", "--port COM7 --move 1", "also move that id, after asking"),
    ("stop", "poses", "", "everything that answers is held, the rest is named"),
    ("hold", "poses", "", "all that answer"),
    ("hold", "poses", "1 2", "these two"),
    ("monitor", "", "--port COM7", "every frame, and all noise"),
    ("monitor", "", "--port COM7 -t delta -n 5", "five, each with the time since the one before"),
    ("monitor", "", "--port COM7 --only noise", "only bytes that are no frame"),
    ("monitor", "", "--port COM7 --log line.hex", "recorded for `decode`"),
    (
        "monitor",
        "",
        "--port COM7 --direction any -t absolute",
        "both ends of a line, the time of day",
    ),
    ("monitor", "", "--port COM7 --hide noise --json", "messages, for a program to read"),
    ("teach", "poses", "poses.json --port COM7", "all ids that answer, at each Enter"),
    ("teach", "poses", "poses.json --port COM7 --ids 1-3 --append", "three ids, added to the file"),
    ("play", "poses", "poses.json --dry-run", "what would be sent, and when"),
    ("play", "poses", "poses.json --port COM7", "from pose to pose, each in a second"),
    (
        "play",
        "poses",
        "poses.json --port COM7 --time-ms 500 --pause 1 --repeat 3",
        "faster, and three times",
    ),
    ("decode", "", "{frame}", "bytes in hex, in any notation"),
    ("decode", "", "line.bin", "a recording, hex or raw bytes"),
    ("decode", "", "--direction {end} -", "what arrives on standard input"),
    ("decode", "", "--json line.bin", "a line of JSON for each message and noise"),
    ("decode", "", "-t absolute line.hex", "a recording, with the time of day"),
    ("decode", "", "--csv line.hex", "a row for each, for a spreadsheet"),
    ("decode", "", "line.bin --csv-tables tables", "a folder of CSV files, one a message"),
    ("decode", "", "line.bin --parquet tables", "a folder of tables, for pandas, Polars or DuckDB"),
    ("decode", "", "line.bin --arrow line.arrow", "all events in one table"),
    ("explain", "", "{frame}", "each byte, and what it says"),
    ("explain", "", "{joined} --direction {sender}", "as sent by the {sender} alone"),
    ("explain", "", "{cut}", "where and why it is no frame"),
    ("docs", "", "", "every message, in a line"),
    ("docs", "", "{message}", "a message: its bytes, fields and examples"),
    ("docs", "number", "{number}", "the messages with this {part}"),
    ("docs", "", "{word}", "whatever has this in its name or its text"),
    ("docs", "", "errata", "where the documents are wrong, and what they leave open"),
    ("docs", "", "lookalikes", "protocols that are easily taken for this one"),
    ("stats", "", "line.hex", "a recording: what came how often, and when"),
    ("stats", "", "line.bin --plot line.svg", "also a drawing of what was measured"),
    ("stats", "", "line.hex --from 1m30s --to 2m --ids 1,3-5", "a part of it, and of these alone"),
    ("stats", "", "--json line.hex", "for a program to read"),
    ("replay", "requests", "line.hex --dry-run", "what would be sent, and when"),
    ("replay", "requests", "line.hex --port COM7", "the recording again"),
    ("replay", "requests", "line.hex --port COM7 --speed 0.5", "at half the speed"),
    ("replay", "requests", "line.bin --port COM7 --skip-noise", "raw bytes, without the noise"),
    ("simulate", "", "", "a device behind a port, whose name is printed first"),
    ("simulate", "", "--help", "all its options"),
    ("answer", "", "", "questions on standard input, until it ends"),
)
