"""The history of MAVLink: definitions become a spec, and a commit that breaks them is told."""

import json
import shutil
from pathlib import Path

import pytest
from framegen.compile import compile_spec
from framegen.language.load import read_source
from framegen.model.codec import encode
from framegen.reading.source import Source

from tests.contract.comparison.mavlink_definitions import (
    crc_extra,
    definitions,
    in_camel_case,
    spec_of,
)
from tests.contract.comparison.mavlink_history import FILES, FOLDER, main
from tests.factories import ROOT, data_of
from tests.repository import commit, start

PUBLISHED = ROOT / "tests" / "protocols" / "mavlink1.yaml"
GIT = shutil.which("git")
# Published definitions, whose byte the spec of MAVLink 1 has from there.
MESSAGES = {
    "HEARTBEAT": """0 uint8_t type, uint8_t autopilot, uint8_t base_mode, uint32_t custom_mode,
        uint8_t system_status, uint8_t_mavlink_version mavlink_version""",
    "SYSTEM_TIME": "2 uint64_t time_unix_usec, uint32_t time_boot_ms",
    "PARAM_REQUEST_READ": """20 uint8_t target_system, uint8_t target_component,
        char[16] param_id, int16_t param_index""",
    "PARAM_VALUE": """22 char[16] param_id, float param_value, uint8_t param_type,
        uint16_t param_count, uint16_t param_index""",
    "ATTITUDE": """30 uint32_t time_boot_ms, float roll, float pitch, float yaw,
        float rollspeed, float pitchspeed, float yawspeed""",
    "TIMESYNC": "111 int64_t tc1, int64_t ts1",
}
ENUM = '<enum name="MAV_TYPE"><entry name="{}" value="2"/></enum>'
QUADROTOR = ENUM.format("MAV_TYPE_QUADROTOR")
RENAMED = ENUM.format("MAV_TYPE_QUADCOPTER")


def xml_of(names: list[str], *, enums: str = QUADROTOR, **retyped: str) -> str:
    """Return these messages as XML, some fields with another type than usual."""
    messages = ""
    for name in names:
        number, _, fields = MESSAGES[name].partition(" ")
        messages += f'<message id="{number}" name="{name}"><description>One.</description>'
        for each in fields.split(","):
            kind, field = each.split()
            kind = retyped.get(field, kind)
            enum = ' enum="MAV_TYPE"' if field == "type" else ""
            messages += f'<field type="{kind}" name="{field}"{enum}>Some.</field>'
        messages += "<extensions/><field type='uint8_t' name='more'>New.</field></message>"
    return f"<mavlink><enums>{enums}</enums><messages>{messages}</messages></mavlink>"


def test_the_byte_of_each_definition_is_the_published_one() -> None:
    published = data_of(PUBLISHED)["messages"].values()
    extras = {message["vendor_name"]: message["id"]["extra"] for message in published}
    found = definitions("common.xml", lambda _: xml_of([*MESSAGES]))
    assert {name: crc_extra(each) for name, each in found.messages.items()} == extras


def test_a_frame_of_the_spec_is_the_published_one() -> None:
    published = compile_spec(read_source(PUBLISHED)).spec
    found = definitions("common.xml", lambda _: xml_of([*MESSAGES]))
    compiled = compile_spec(Source("mavlink.yaml", json.dumps(spec_of(found))))
    assert {finding.rule for finding in compiled.findings} == {"no-example"}
    assert compiled.derived is not None
    example = published.messages["ParameterRead"].examples[0]
    renamed = {"index": "param_index", "name": "param_id", "sender": "frame_sender"}
    values = {renamed.get(name, name): each for name, each in example.values.items()}
    values["frame_sequence"] = values.pop("sequence")
    layout = compiled.derived.messages[in_camel_case("PARAM_REQUEST_READ")]
    assert encode(layout, values) == example.hex


def committed(folder: Path, text: str, subject: str) -> None:
    """Commit an edition; all messages are in common.xml."""
    start(folder)
    files = {f"{FOLDER}/{name}": "<mavlink/>" for name in FILES}
    commit(folder, {**files, f"{FOLDER}/common.xml": text}, message=subject)


@pytest.mark.skipif(GIT is None, reason="there is no git here")
def test_each_commit_is_told_with_what_it_breaks(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    names = ["HEARTBEAT", "SYSTEM_TIME"]
    committed(tmp_path, xml_of(names), "Begin")
    committed(tmp_path, xml_of(names, time_boot_ms="uint64_t"), "Widen a field")
    committed(tmp_path, "<mavlink", "Begin a merge")
    committed(tmp_path, xml_of(names), "Back out")
    committed(tmp_path, xml_of(names, enums=RENAMED), "Rename a value")
    committed(tmp_path, xml_of(["HEARTBEAT"], enums=RENAMED), "Remove a message")
    main(str(tmp_path))
    told = capsys.readouterr().out
    verdicts = [line.strip() for line in told.splitlines() if "|" in line and "(" in line]
    assert verdicts == [
        "SYSTEM_TIME (SystemTime): CRC_EXTRA | old: all refused, new: all refused",
        "SYSTEM_TIME (SystemTime): CRC_EXTRA | old: all refused, new: all refused",
        "HEARTBEAT (Heartbeat): value renamed | old: uncertain, new: uncertain",
        "SYSTEM_TIME (SystemTime): removed | old: all refused",
    ]
    assert "Begin a merge: " in told
    counts = {
        name: int(number)
        for number, _, name in (line.strip().partition(" ") for line in told.splitlines())
        if number.isdecimal()
    }
    assert counts["editions"] == 6
    assert counts["not usable"] == 1
    assert counts["pairs that differ"] == 4
