"""The workbench in a real browser, after use: noise, files, long captures, links, the encoder."""

import io
import re
from pathlib import Path

import pytest
from busservo import recordings
from busservo._library import CODEC
from framegen.cli import main
from framegen.language.values import to_hex
from framegen.model.codec import encode
from framewire.command.entries import EntryLines
from playwright.sync_api import Browser, Locator
from playwright.sync_api import Page as Tab

from tests.factories import in_larger_unit
from tests.protocols.specs import FILES, messages_of
from tests.unit.site.browser import Visit, decoded, needs_chromium, site_on_disk, texts
from tests.unit.site.looks import WIDTHS, faults
from tests.unit.site.reference import ROOT, reference
from tests.world.conftest import visiting

SITE = reference("busservo")
CUT_OFF = ROOT / "tests" / "captures" / "cut_off.hex"

MOVE = "55 55 08 03 01 E8 03 01 20 03"
EITHER = "55 55 05 06 08 01 00"
MIXED = f"00 FF {MOVE} 55 55 03 63 01 {EITHER} 55 55 02"

pytestmark = needs_chromium


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the reference in a folder, as `framegen docs` builds it."""
    return site_on_disk(tmp_path_factory.mktemp("stick") / "the workbench")


@pytest.fixture
def bench(visit: Visit) -> Tab:
    return visit.open("decoder.html")


def fill(tab: Tab, text: str) -> None:
    tab.get_by_label("A capture").fill(text)


def status(tab: Tab) -> str:
    return tab.locator("#decoded").inner_text()


def rows(tab: Tab) -> Locator:
    return tab.locator("#events [role=option]")


def detail(tab: Tab) -> str:
    return " ".join(tab.locator("#event").inner_text().split())


def wait_for(tab: Tab, what: str) -> None:
    tab.wait_for_function(
        "(what) => document.getElementById('decoded').textContent.includes(what)", arg=what
    )


# ---------------------------------------------------------------------------- what is decoded


def decoded_in_turn(tab: Tab, lines: list[str]) -> list[tuple[list[str], str, list[str]]]:
    """Return rows, status and cells for each of these inputs, filled in one by one."""
    shown = tab.evaluate(
        """(lines) => lines.map((line) => {
            const texts = (selector) =>
                [...document.querySelectorAll(selector)].map((each) => each.innerText);
            const field = document.getElementById("hex");
            field.value = line;
            field.dispatchEvent(new Event("input", { bubbles: true }));
            return [texts("#events .what b"), texts("#decoded"), texts("#event .strip li")];
        })""",
        lines,
    )
    return [
        (names, said, [" ".join(each.split()) for each in cells]) for names, [said], cells in shown
    ]


def test_an_example_is_cut_into_the_same_cells_as_on_its_page(visit: Visit) -> None:
    shown: dict[str, dict[str, list[str]]] = {}
    for name, message in SITE.model.messages.items():
        tab = visit.open(f"messages/{name}.html")
        for number, example in enumerate(message.message.examples, 1):
            cells = texts(tab.locator(f"#example-{number} .strip").first.locator("li"))
            found = [" ".join(each.split()) for each in cells]
            shown.setdefault(message.direction.key, {})[example.hex.hex()] = found
    tab = visit.open("decoder.html")
    for way, examples in shown.items():
        tab.get_by_label("Sent", exact=True).select_option(way)
        entries = decoded_in_turn(tab, [*examples])
        assert [strip for _, _, strip in entries] == [*examples.values()]


def test_values_are_shown_in_their_larger_unit_as_they_are_explained(bench: Tab) -> None:
    scales = ["0.001 V", "0.01 K", "0.25 degrees", "12.5 m", "10 Pa", "0.000010 s", "0.01"]
    values = [0, 1, -1, 7, -150, 99, 7500, 65535, -0x8000_0000, 0xFFFF_FFFF]
    for text in scales:
        step, _, unit = text.partition(" ")
        shown = bench.evaluate(
            "([values, scale]) => values.map((value) => scaled(value, scale))",
            [values, {"step": step, "unit": unit}],
        )
        assert shown == [in_larger_unit(text, value) for value in values]


def test_frames_noise_and_unknown_frames_are_shown(bench: Tab) -> None:
    fill(bench, MIXED)
    assert decoded(bench) == [
        *("noise: bad header", "ServoMove", "unknown: unknown command"),
        *("ActionGroupRun or ActionGroupStarted", "noise: too short"),
    ]
    rows(bench).nth(1).click()
    cells = [" ".join(cell.split()) for cell in texts(bench.locator("#event .strip li"))]
    assert cells[4:6] == ["7 E8 03 time_ms 1000 ms low byte first", "9 01 targets[0].servo_id 1"]


def test_a_frame_that_is_legal_both_ways_has_both_names(bench: Tab) -> None:
    fill(bench, EITHER)
    assert decoded(bench) == ["ActionGroupRun or ActionGroupStarted"]
    assert rows(bench).locator(".who").inner_text() == "either"
    assert "These bytes are a frame in each direction" in detail(bench)
    assert texts(bench.locator("#event h4 a")) == ["ActionGroupRun", "ActionGroupStarted"]
    bench.get_by_label("Sent", exact=True).select_option("controller_to_host")
    assert decoded(bench) == ["ActionGroupStarted"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("55 55 09 03 01 E8 03 01 20 03", "ServoMove has a length of 8, 11, 14 .. 254, not 9"),
        ("55 55 08 03 01", "a length of 8 makes 10 bytes"),
        ("55 55 03 63 01", "no message host -> controller has the command 99"),
    ],
)
def test_a_refusal_says_why_with_its_numbers(bench: Tab, text: str, said: str) -> None:
    fill(bench, text)
    assert said in detail(bench)
    # What was meant stands before why it is refused.
    fill(bench, "55 55 01 07 01 20 03 E8 03 E8")
    meant = detail(bench)
    assert meant.index("This looks like a frame of the LX-16A") < meant.index("has a length of")


def test_the_right_frame_takes_the_place_of_the_wrong_one(bench: Tab) -> None:
    fill(bench, "55 55 02 0F 55 55 09 03 01 E8 03 01 20 03 55 55 02 0F")
    assert len(decoded(bench)) == 3
    rows(bench).nth(1).click()
    bench.get_by_role("button", name="Take this frame").click()
    assert decoded(bench) == ["BatteryVoltageRead", "ServoMove", "BatteryVoltageRead"]
    assert rows(bench).nth(1).get_attribute("aria-selected") == "true"
    bench.go_back()
    assert decoded(bench)[1] == "noise: length mismatch"


@pytest.mark.parametrize("text", ["", "   ", "# nothing\n"])
def test_an_empty_field_is_no_fault(bench: Tab, text: str) -> None:
    fill(bench, text)
    assert status(bench) == "Paste bytes, or drop a file here."
    assert not bench.locator("#problem").is_visible()
    assert not bench.locator("#event").is_visible()


# ---------------------------------------------------------------------------- what people have


ENDS = ["host →", "← controller"]


def test_lines_of_a_recording_keep_their_directions_and_times_in_a_link_too(visit: Visit) -> None:
    tab = visit.open("decoder.html")
    # A short file of text comes into the field.
    drop(tab, "cut_off.hex", CUT_OFF.read_bytes())
    wait_for(tab, "Read as lines of a recording")
    assert tab.locator("#hex").input_value() == CUT_OFF.read_text("utf-8")
    assert texts(rows(tab).locator(".who")) == [*ENDS, "noise", *ENDS, "← controller"]
    assert texts(rows(tab).locator(".place"))[:2] == ["0.000000", "0.011458"]
    other = visit.open(f"decoder.html?{copied_link(tab).partition('?')[2]}")
    assert texts(rows(other).locator(".who"))[:2] == ENDS


def copied_link(tab: Tab) -> str:
    tab.get_by_role("button", name="Copy link").click()
    return str(tab.evaluate("navigator.clipboard.readText()"))


@pytest.mark.parametrize(
    ("text", "said", "selected"),
    [
        ("55 55\n02 5G", "Line 2, column 5: “G” in “5G” is no hex digit", "G"),
        ("[85, 300]", "Line 1, column 6: “300” is no byte", "300"),
        ("55 # 0.5 s, nobody: x", "Line 1, column 13: “nobody”", "nobody"),
    ],
)
def test_what_cannot_be_read_is_shown(bench: Tab, text: str, said: str, selected: str) -> None:
    fill(bench, text)
    assert said in bench.locator("#problem").inner_text()
    assert bench.locator("#hex").get_attribute("aria-invalid") == "true"
    assert decoded(bench) == []
    bench.get_by_role("button", name="Show the place").click()
    chosen = bench.evaluate(
        """() => { const { value, selectionStart, selectionEnd } = document.activeElement;
            return value.slice(selectionStart, selectionEnd); }"""
    )
    assert chosen == selected
    fill(bench, MOVE)
    assert not bench.locator("#problem").is_visible()
    assert bench.locator("#hex").get_attribute("aria-invalid") == "false"


def test_what_is_typed_never_becomes_html(bench: Tab) -> None:
    fill(bench, "<img src=x onerror=alert(1)>")
    assert bench.locator("main img").count() == 0
    assert "is an argument, not a byte" in bench.locator("#problem").inner_text()


def drop(tab: Tab, name: str, data: bytes) -> None:
    """Drop a file on the page."""
    tab.evaluate(
        """([name, data]) => {
            const transfer = new DataTransfer();
            transfer.items.add(new File([Uint8Array.from(data)], name));
            document.dispatchEvent(new DragEvent("drop",
                { dataTransfer: transfer, bubbles: true, cancelable: true }));
        }""",
        [name, [*data]],
    )


def test_a_file_of_raw_bytes_is_dropped(bench: Tab) -> None:
    drop(bench, "line.bin", bytes.fromhex(MIXED))
    wait_for(bench, "Read as raw bytes")
    assert decoded(bench)[1] == "ServoMove"
    assert "line.bin" in bench.locator("#source").inner_text()
    bench.get_by_role("button", name="Close it").click()
    assert decoded(bench) == []
    assert not bench.locator("#source").is_visible()


def test_a_file_that_windows_wrote_is_text(bench: Tab, tmp_path: Path) -> None:
    file = tmp_path / "monitor.txt"
    file.write_bytes(b"\xff\xfe" + CUT_OFF.read_text("utf-8").encode("utf-16le"))
    bench.locator("#file").set_input_files(file)
    wait_for(bench, "lines of a recording")
    assert len(decoded(bench)) == 6


def test_a_long_file_that_is_neither_is_read_raw_when_asked(bench: Tab, tmp_path: Path) -> None:
    file = tmp_path / "notes.txt"
    file.write_text("These are no bytes.\n" * 2000)
    bench.locator("#file").set_input_files(file)
    bench.get_by_role("button", name="Read the file as raw bytes").click()
    wait_for(bench, "40,000 bytes of noise")


# ---------------------------------------------------------------------------- long captures


def test_only_what_is_seen_of_a_long_capture_is_drawn(bench: Tab) -> None:
    fill(bench, f"{MOVE}\n" * 10_000 + "FF")
    wait_for(bench, "10,000 messages, 1 byte of noise")
    assert rows(bench).count() < 60
    bench.locator("#events").focus()
    bench.keyboard.press("End")
    last = bench.locator("#events [aria-selected=true]")
    assert last.get_attribute("aria-posinset") == last.get_attribute("aria-setsize") == "10001"
    assert last.get_attribute("id") == bench.locator("#events").get_attribute(
        "aria-activedescendant"
    )
    assert "Noise: bad header" in detail(bench)
    bench.keyboard.press("PageUp")
    bench.keyboard.press("ArrowUp")
    bench.keyboard.press("Home")
    assert last.get_attribute("aria-posinset") == "1"
    assert rows(bench).count() < 60


def test_a_list_longer_than_a_browser_draws_is_there_to_its_end(bench: Tab, tmp_path: Path) -> None:
    file = tmp_path / "long.bin"
    file.write_bytes(bytes.fromhex("55 55 02 0F") * 400_000)
    bench.locator("#file").set_input_files(file)
    wait_for(bench, "400,000 messages, 0 bytes of noise")
    bench.locator("#events").focus()
    bench.keyboard.press("End")
    chosen = bench.locator("#events [aria-selected=true]")
    assert chosen.get_attribute("aria-posinset") == "400000"
    bench.keyboard.press("ArrowUp")
    assert chosen.get_attribute("aria-posinset") == "399999"
    bench.get_by_label("Byte", exact=True).fill("0x1000")
    bench.get_by_role("button", name="Go").click()
    assert chosen.locator(".place").inner_text() == "4096"
    box, row = bench.locator("#events").bounding_box(), chosen.bounding_box()
    assert box is not None
    assert row is not None
    assert box["y"] <= row["y"] <= box["y"] + box["height"]


def test_what_was_begun_is_given_up_if_something_else_is_typed(bench: Tab, tmp_path: Path) -> None:
    file = tmp_path / "long.bin"
    file.write_bytes(bytes.fromhex("55 55 02 0F") * 2_000_000)
    bench.locator("#file").set_input_files(file)
    bench.get_by_role("button", name="Stop").click()
    wait_for(bench, "messages")
    assert not bench.locator("#progress").is_visible()
    fill(bench, MOVE)
    assert decoded(bench) == ["ServoMove"]


@pytest.mark.parametrize("width", WIDTHS)
def test_long_noise_widens_no_page(bench: Tab, width: int) -> None:
    bench.set_viewport_size({"width": width, "height": 800})
    fill(bench, f"{MOVE} {'00 A5 ' * 1000}{MOVE}")
    rows(bench).nth(1).click()
    assert "2,000 bytes" in detail(bench)
    dump = bench.locator("#event .dump")
    assert len(dump.inner_text()) < 400
    dump.get_by_role("button").click()
    assert dump.inner_text().split() == ["00", "A5"] * 1000
    assert faults(bench) == []


def test_messages_and_noise_are_counted_and_found(bench: Tab) -> None:
    fill(bench, f"{MIXED} {MIXED}")
    tally = bench.locator("#tally")
    tally.get_by_role("button", name=re.compile("^ServoMove")).click()
    assert decoded(bench) == ["ServoMove", "ServoMove"]
    tally.get_by_role("button", name=re.compile("^All")).click()
    assert len(decoded(bench)) > 6
    chosen = bench.locator("#events [aria-selected=true] .who")
    bench.get_by_role("button", name="Next unknown frame").click()
    assert chosen.inner_text() == "unknown"
    bench.get_by_role("button", name="Next noise").click()
    assert chosen.inner_text() == "noise"


# ---------------------------------------------------------------------------- links and files


@pytest.mark.parametrize(
    ("word", "chosen"),
    [(word, "controller_to_host") for word in ("controller", "controller_to_host")]
    + [("nobody", "")],
)
def test_an_address_names_the_direction_or_who_sends_or_leaves_both_open(
    visit: Visit, word: str, chosen: str
) -> None:
    tab = visit.open(f"decoder.html?hex=5555040f4c1d&direction={word}")
    assert tab.get_by_label("Sent", exact=True).input_value() == chosen
    assert decoded(tab) == ["BatteryVoltage"]


def test_a_link_holds_the_capture_the_direction_and_the_encoder(visit: Visit) -> None:
    tab = visit.open("decoder.html")
    fill(tab, MIXED)
    tab.get_by_label("Sent", exact=True).select_option("host_to_controller")
    tab.get_by_label("Message").select_option("ServoMove")
    tab.locator("#words").fill("time_ms=800 targets=1:600,2:400")
    link = copied_link(tab)
    assert link.endswith(
        f"?hex={MIXED.replace(' ', '')}&direction=host_to_controller&message=ServoMove"
        "&time_ms=800&targets=1:600,2:400"
    )
    shown = decoded(tab)
    other = visit.open(f"decoder.html?{link.partition('?')[2]}")
    assert decoded(other) == shown
    assert other.locator("#words").input_value() == "time_ms=800 targets=1:600,2:400"
    assert other.locator("#encoded").inner_text() == "55 55 0B 03 02 20 03 01 58 02 02 90 01"


def test_a_capture_that_is_too_long_for_a_link_is_left_out_and_that_is_said(bench: Tab) -> None:
    fill(bench, f"{MOVE}\n" * 2000)
    wait_for(bench, "2,000 messages")
    bench.get_by_role("button", name="Copy link").click()
    bench.wait_for_function(
        "() => document.getElementById('announcement').textContent.includes('too long')"
    )
    assert "hex=" not in str(bench.evaluate("navigator.clipboard.readText()"))


@pytest.mark.parametrize(("name", "form"), [("CSV", "csv"), ("JSON lines", "json")])
def test_a_capture_is_saved_as_the_command_prints_it(bench: Tab, name: str, form: str) -> None:
    text = CUT_OFF.read_text("utf-8")
    fill(bench, text)
    with bench.expect_download() as found:
        bench.get_by_role("button", name=name).click()
    screen = io.StringIO()
    lines = EntryLines(screen, form, CODEC)
    for entry in recordings.read(io.BytesIO(text.encode())):
        lines.show(entry)
    assert Path(found.value.path()).read_text("utf-8") == screen.getvalue()


# ---------------------------------------------------------------------------- the encoder


@pytest.mark.parametrize(
    ("words", "said", "selected"),
    [
        ("time_ms=800 targets=1:2:3", "targets[0]: “1:2:3” is not servo_id:position", "1:2:3"),
        ("time_ms=1e3 targets=1:2", "time_ms: “1e3” is no number", "1e3"),
        ("time_ms=800 targets=1:800,,2:3", "targets[1]", None),
        ("time_ms=800 targets=1:800, 2:3", "targets[1]", None),
        ("time_ms=800 targets=1:70000", "targets[0].position: 70000 is outside 0..65535", None),
    ],
)
def test_the_encoder_refuses_what_it_does_not_understand(
    bench: Tab, words: str, said: str, selected: str | None
) -> None:
    bench.get_by_label("Message").select_option("ServoMove")
    bench.locator("#words").fill(words)
    assert said in bench.locator("#encoder-problem").inner_text()
    assert bench.locator("#copy-frame").is_disabled()
    assert bench.locator("#encoded").inner_text() == ""
    if selected is not None:
        bench.locator("#encoder-problem").get_by_role("button").click()
        chosen = "document.activeElement.value.slice(document.activeElement.selectionStart)"
        assert bench.evaluate(chosen).startswith(selected)
    bench.locator("#words").fill("time_ms=800 targets=1:2")
    assert bench.locator("#encoder-problem").inner_text() == ""
    assert bench.locator("#copy-frame").is_enabled()


def test_what_the_encoder_offers_is_the_first_example_of_each_message(
    browser: Browser, tmp_path: Path
) -> None:
    assert main(["docs", str(FILES["everything"]), "--out", str(tmp_path)]) == 0
    with visiting(browser, tmp_path / "reference" / "everything") as visit:
        tab = visit.open("decoder.html")
        for name, layout in messages_of("everything").items():
            example = layout.message.examples[0]
            tab.get_by_label("Message").select_option(name)
            offered = tab.locator("#encoded").inner_text()
            assert offered == to_hex(encode(layout, example.values)), name
            fill(tab, to_hex(example.hex))
            assert any(name in each.split(" or ") for each in decoded(tab))


def test_a_decoded_frame_is_edited_in_the_encoder(bench: Tab) -> None:
    for message in SITE.model.messages.values():
        for example in message.message.examples:
            bench.get_by_label("Sent", exact=True).select_option(message.direction.key)
            fill(bench, to_hex(example.hex))
            bench.get_by_role("button", name="Edit in the encoder").click()
            assert bench.get_by_label("Message").input_value() == message.name
            assert bench.locator("#encoded").inner_text() == to_hex(example.hex)


def test_the_encoder_takes_named_values(bench: Tab) -> None:
    bench.get_by_label("Message").select_option("ActionGroupRun")
    bench.locator("#words").fill("group=8 times=unlimited")
    assert bench.locator("#encoded").inner_text() == "55 55 05 06 08 00 00"
    bench.get_by_role("button", name="Decode it").click()
    assert decoded(bench) == ["ActionGroupRun or ActionGroupStarted"]


# ---------------------------------------------------------------------------- for everybody


def test_paper_holds_the_list_and_the_event(bench: Tab) -> None:
    fill(bench, f"{MOVE}\n" * 300)
    bench.emulate_media(media="print")
    bench.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert rows(bench).count() == 300
    assert bench.evaluate("getComputedStyle(document.getElementById('events')).overflowY") == (
        "visible"
    )
    bench.evaluate("dispatchEvent(new Event('afterprint'))")
    bench.emulate_media(media="screen")
    assert rows(bench).count() < 60


def test_what_a_busy_line_says_is_drawn_together(bench: Tab) -> None:
    said = bench.evaluate(
        """async (frame) => {
          let drawn = 0;
          const status = document.getElementById("decoded");
          const watch = new MutationObserver((records) => { drawn += records.length; });
          watch.observe(status, { childList: true });
          for (let round = 0; round < 500; round++) {
            const bytes = Uint8Array.from(frame);
            const event = { type: "message", bytes, size: bytes.length };
            workbench.append([{ time: round / 1000, sender: "host", event }]);
            if (round % 100 === 0) await new Promise((resolve) => setTimeout(resolve));
          }
          while (!status.textContent.startsWith("5,000")) {
            await new Promise(requestAnimationFrame);
          }
          return [drawn < 50, status.textContent];
        }""",
        list(bytes.fromhex(MOVE)),
    )
    assert said == [True, "5,000 bytes: 500 messages, 0 bytes of noise."]
