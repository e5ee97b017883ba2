"""What stands on the page of a message besides its layout: notes, errata, unknowns and guides."""

from __future__ import annotations

import re
from html import unescape

from framegen.model.slots import Items
from framegen.render import snippets
from framegen.site.guides.guide import Guide
from framegen.site.guides.mentions import Mentions
from framegen.site.project import Project
from framegen.site.site import Site
from framegen.targets.docs.field import field_views

from tests.factories import compiled_file
from tests.in_turn import in_turn
from tests.protocols.specs import FILES
from tests.unit.site.reference import Page, reference

SERVO = reference("busservo")
SPEC = SERVO.model.spec
MESSAGES = [*SERVO.model.messages]


def page_of(message: str) -> Page:
    return SERVO.pages[f"messages/{message}.html"]


def words(text: str) -> str:
    return " ".join(unescape(re.sub(r"<[^>]+>", "", text)).split())


@in_turn("message", lambda: MESSAGES)
def test_what_the_board_shows_stands_on_what_it_receives_and_nowhere_else(message: str) -> None:
    """LED2 and the buzzer are the only acknowledgement that most commands have."""
    sent = SERVO.model.messages[message].direction.receiver == "controller"
    for text in (page_of(message).words, SERVO.files[f"messages/{message}.md"]):
        assert ("LED2" in text and "the buzzer beeps twice" in text) == sent
    said = SPEC.messages[message]
    for note in said.notes:
        cited = f"{note.text} {note.cite}"
        assert cited in " ".join(page_of(message).words.split())
        assert note.text in SERVO.files[f"messages/{message}.md"]


def test_every_note_is_cited_where_sequences_and_the_protocol_are_described() -> None:
    board = SPEC.endpoints["controller"].notes
    for path, notes in (("sequences", board), ("index", [*board, *SPEC.protocol.notes])):
        shown = " ".join(SERVO.pages[f"{path}.html"].words.split())
        for note in notes:
            assert f"{note.text} {note.cite}" in shown
    cheat = SERVO.pages["cheatsheet.html"].words
    assert all(note.text in cheat for note in board)


@in_turn("message", lambda: MESSAGES)
def test_errata_and_unknowns_of_a_message_stand_on_its_page_alone(message: str) -> None:
    page, text = page_of(message), words(page_of(message).text)
    numbers = [n for n, each in enumerate(SPEC.errata, 1) if each.concerns.message == message]
    assert [each for each in page.ids if each.startswith("erratum-")] == [
        f"erratum-{number}" for number in numbers
    ]
    for number, erratum in enumerate(SPEC.errata, 1):
        own = number in numbers
        assert (erratum.title in text) == own
        assert (
            (f"{SERVO.folder}errata.html", f"erratum-{number}") in map(page.leads_to, page.links)
        ) == own
        back = SERVO.pages["errata.html"]
        assert (
            (f"{SERVO.folder}messages/{message}.html", f"erratum-{number}")
            in map(back.leads_to, back.links)
        ) == own
    for unknown in SPEC.unknowns:
        assert (unknown.what in text) == (unknown.concerns.message == message)


@in_turn("name", lambda: [*FILES, "busservo"])
def test_a_count_has_the_range_that_can_be_on_the_wire(name: str) -> None:
    model = SERVO.model if name == "busservo" else compiled_file(FILES[name]).model
    for layout in model.messages.values():
        shown = {view.path: view.range for view in field_views(model, layout)}
        for items in (slot for slot in layout.body if isinstance(slot, Items)):
            for counter in items.counters:
                if counter.name not in shown:
                    continue
                ends = [items.counted(counter, count) for count in (items.low, items.high)]
                expected = f"always {ends[0]}" if ends[0] == ends[1] else f"{ends[0]}..{ends[1]}"
                assert shown[counter.name] == expected


@in_turn(
    "message, shown",
    lambda: [("ServoMove", "1..83"), ("ServoUnload", "1..252"), ("ServoPositions", "0..84")],
)
def test_the_counts_of_the_board(message: str, shown: str) -> None:
    (row,) = re.findall(r'<tr id="field-servo_count">.*?</tr>', page_of(message).text, re.DOTALL)
    assert f'<td data-label="Range">{shown}</td>' in row


def test_the_formula_of_a_look_alike_is_the_proof() -> None:
    text = words(SERVO.pages["lookalikes.html"].text)
    assert "checksum = ~(servo_id + length + command + parameters) & 0xFF" in text
    [example] = SPEC.lookalikes["lx16a"].examples
    *front, checksum = example.hex
    assert checksum == ~sum(front[2:]) & 0xFF
    total = " + ".join(f"{byte:02X}" for byte in front[2:])
    assert f"checksum: {total} = {sum(front[2:]):02X}, of which" in text


def test_pages_spell_directions_as_prose_does() -> None:
    arrows = {
        path: re.findall(r".{30}\w -> \w.{20}", page.words)
        for path, page in SERVO.pages.items()
        if path not in ("spec.html", "decoder.html")
    }
    assert {path: each for path, each in arrows.items() if each} == {}


def test_no_heading_of_a_table_is_empty_and_no_badge_repeats_its_link() -> None:
    for path, page in SERVO.pages.items():
        assert not re.search(r"<th[^>]*>\s*</th>", page.text), path
        for link, badge in re.findall(
            r'>([^<>]+)</a>[^<]*<span class="badge">(\w+)</span>', page.text
        ):
            assert badge not in link.lower(), (path, link)


GUIDE = """# The arm

Above all: `busservo`.

## Moving

```python
controller.move_servos([(1, 800)], time_ms=1000)
```

## Letting go

See [ServoUnload](reference/busservo/messages/ServoUnload.md#fields), not ServoMove.

## A word

`ServoMove(...)` is a class, `remove_servos` is none, and neither is controller.ServoMover.
"""
OTHER = GUIDE.replace("# The arm", "# Elsewhere").replace("`busservo`", "another library")


@in_turn(
    "message, expected",
    lambda: [
        ("ServoMove", ["The arm: Moving, A word"]),
        ("ServoUnload", ["The arm: Letting go", "Elsewhere: Letting go"]),
        ("BatteryVoltage", []),
    ],
)
def test_guides_speak_of_a_message_where_they_link_to_it_or_use_it(
    message: str, expected: list[str]
) -> None:
    path = f"reference/busservo/messages/{message}"
    published = {f"{path}.md": f"{path}.html"}
    guides = [Guide("arm.md", GUIDE, published), Guide("other.md", OTHER, published)]
    site = Site(Project([SERVO.compiled]), snippets())
    (view,) = [each.reference for each in site.references]
    (shown,) = [each for each in view.messages if each.name == message]
    found = [
        f"{each.guide}: {', '.join(section.heading for section in each.sections)}"
        for each in Mentions(guides).of(shown, f"{path}.html")
    ]
    assert found == expected


def test_the_bytes_come_first_and_wide_numbers_say_their_order() -> None:
    wrong = []
    for message in MESSAGES:
        page = page_of(message).text
        order = [page.find(f'id="{part}"') for part in ("bytes", "fields", "facts", "errata")]
        found = [place for place in order if place >= 0]
        if found != sorted(found) or -1 in order[:3]:
            wrong.append(f"{message}: {order}")
        wrong += [f"{message}: {tail}" for tail in re.findall(r'"field">[iu](?:16|32)<', page)]
    assert wrong == []
    assert "u16, low byte first" in page_of("ServoMove").text
