"""Questions to the search as people ask them, and the pages that answer them."""

from __future__ import annotations

from tests.unit.site.test_search import found, needs_node

# One of these pages is among the first three hits, without `.html`; `@` stands for
# `reference/busservo/`, `@@` for `reference/lxservo/`, `:` for `messages/`.
QUESTIONS: dict[str, str] = {
    # Students, on the first day.
    "how to install": "getting-started captures",
    "how do I install this on windows": "getting-started",
    "raspberry pi": "getting-started",
    "how do i wire my board": "getting-started",
    "which baud rate": "@index",
    "what is busservo": "@index getting-started",
    "where do I start": "getting-started",
    "my first program": "getting-started",
    "can I try it without hardware": "getting-started test-your-robot",
    "is there a simulator": "test-your-robot getting-started",
    "how to uninstall": "getting-started",
    "which port is my board on": "getting-started troubleshooting",
    # Makers, with an arm that does something else.
    "my reply is wrong": "troubleshooting",
    "arm does not move": "troubleshooting",
    "why is there no answer from the board": "troubleshooting lx16a",
    "my servo moves to the wrong position": "troubleshooting",
    "the board beeps, what does it mean": "troubleshooting getting-started",
    "permission denied when I open the port": "troubleshooting",
    "how do I stop the arm": "troubleshooting @:ActionGroupStop @@:MoveStop",
    "how do I move two servos at the same time": "@:ServoMove talk-to-the-board",
    "read the position of my servo": "@:ServoPositionsRead @@:PositionRead",
    "how to make the servo limp": "@:ServoUnload",
    "how do I know that the move is finished": "talk-to-the-board",
    "change the id of a servo": "@@:ServoIdWrite lx16a",
    "is my battery low": "@:BatteryVoltageRead @:BatteryVoltage",
    "what voltage is my batery": "@:BatteryVoltageRead @:BatteryVoltage @@:Voltage @@:VoltageRead",
    "my servo gets too hot": "@@:TemperatureLimitWrite",
    "play back recorded poses": "command",
    "Arduino": "@lookalikes troubleshooting",
    "usb hid": "getting-started troubleshooting talk-to-the-board",
    "is this the right protocol for my arm": "@lookalikes troubleshooting",
    "run several servos on one wire without a controller": "lx16a",
    # Those who write a codec, or read bytes.
    "position reply layout": "@:ServoPositions",
    "battery reply bytes": "@:BatteryVoltage",
    "move command format": "@:ServoMove",
    "what does the length byte count": "@index @stream write-a-spec design",
    "is it little endian": "@errata @index what-changes-break",
    "how is the checksum calculated": "@@index @@stream @stream write-a-spec",
    "list of all commands": "@index @cheatsheet",
    "cheatsheet": "@cheatsheet @@cheatsheet",
    "decode my bytes": "@decoder @@decoder command codec",
    "how do I resync after garbage": "@stream design",
    "error in the vendor documentation": "@errata",
    "conformance": "conformance",
    "test my own implementation": "conformance",
    "parse a stream of bytes": "codec @stream",
    # Those who log and analyse.
    "log the traffic": "command",
    "plot a capture": "captures",
    "pandas dataframe": "captures",
    "export to csv": "command captures @decoder",
    # Maintainers.
    "how to add a command": "changing-the-protocol",
    "rename a field": "changing-the-protocol",
    "is this a breaking change": "what-changes-break changing-the-protocol",
    "how do I contribute": "project/contributing",
    "how fast is it": "project/benchmarks captures",
    "what is new": "project/changelog @changelog",
    # Publishers, with a protocol of their own.
    "describe my own protocol": "write-a-spec",
    "publish docs": "publish",
    "github pages": "publish",
    "where can I host the docs": "publish",
    "hosting": "publish",
    "licence": "project/contributing write-a-spec what-changes-break",
    "guess the protocol from a recording": "guess-a-spec",
}


def pages_of(answers: str) -> list[str]:
    full = answers.replace("@@", "reference/lxservo/").replace("@", "reference/busservo/")
    return [f"{page}.html" for page in full.replace(":", "messages/").split()]


@needs_node
def test_questions_lead_to_a_page_that_answers_them() -> None:
    failed = []
    for (question, answers), answer in zip(QUESTIONS.items(), found([*QUESTIONS]), strict=True):
        first = [path.partition("#")[0] for path in answer["paths"][:3]]
        if not set(first) & {*pages_of(answers)}:
            failed.append(f"{question}: {answers}, not {answer['titles'][:3]} at {first}")
    assert not failed, f"{len(failed)} of {len(QUESTIONS)}:\n" + "\n".join(failed)
