"""Each number of several bytes says which is first: on pages, in Markdown, and in a shell."""

import re
from collections.abc import Callable, Iterable, Iterator
from importlib import import_module
from pathlib import Path

import pytest

from tests.factories import DEMO, compiled_file, library, library_of
from tests.in_turn import in_turn
from tests.unit.site.reference import SPECS, Reference

EVERYTHING = DEMO.with_name("everything.yaml")
LOW, HIGH = "low byte first", "high byte first"

# A spec, a message, and what is said of its parts; of all others nothing is.
ROWS = [
    (SPECS["busservo"], "ServoMove", {"time_ms": LOW, "targets[i].position": LOW}),
    (SPECS["busservo"], "BatteryVoltage", {"voltage_mv": LOW}),
    (SPECS["busservo"], "ActionGroupRun", {"times": LOW}),
    (SPECS["busservo"], "ActionGroupSpeed", {"percent": LOW}),
    (
        EVERYTHING,
        "Flags",
        {
            **dict.fromkeys(("unused", "position", "temperature"), HIGH),  # the first is reserved
            "mode": LOW,
            "mark": LOW,  # a constant
        },
    ),
    (
        EVERYTHING,
        "Lists",
        {
            **dict.fromkeys(("station", "length", "angles[i]", "readings[i].delta", "check"), LOW),
            **dict.fromkeys(("triple[i]", "points[i].x", "bytes_left", "readings[i].value"), HIGH),
            "channels": "high byte and high bits first",
            "low_bits": "low byte and low bits first",
        },
    ),
    (EVERYTHING, "Tail", {"first": HIGH, "third": HIGH, "fourth": LOW}),
]
ORDER = re.compile(r"(?:low|high) (?:byte and \w+ bits|byte|bits) first")


@pytest.fixture(scope="module")
def references() -> Iterator[dict[Path, tuple[Reference, Callable[[list[str]], int]]]]:
    """Yield the reference of each spec, and the command of its library."""
    with library(library_of(EVERYTHING)) as everything:
        packages = {SPECS["busservo"]: "busservo", EVERYTHING: everything.__name__}
        yield {
            spec: (Reference(compiled_file(spec)), import_module(f"{name}.__main__").main)
            for spec, name in packages.items()
        }


def said(rows: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Return what is said of the order of each part; `rows` are the parts with their texts."""
    found = ((part, ORDER.search(text)) for part, text in rows)
    return {part: order[0] for part, order in found if order}


def drawn(page: str) -> dict[str, str]:
    cells = page.partition('<ol class="strip"')[2].partition("</ol>")[0].split("<li")[1:]
    return said((re.findall(r'"name">([^<]*)<', cell)[0], cell) for cell in cells)


def described(page: str) -> dict[str, str]:
    row = r'<th scope="row" class="field"><code>([^<]*)</code>.*?data-label="Type"[^>]*>([^<]*)<'
    return said(re.findall(row, page, re.DOTALL))


def listed(text: str, columns: str) -> dict[str, str]:
    """Return what a table in Markdown says, found by its columns."""
    found = said(re.findall(columns, text.partition("## About it")[0], re.MULTILINE))
    return {part.replace("\\", ""): order for part, order in found.items()}


def typed(lines: str, column: int) -> dict[str, str]:
    rows = [re.split(r" {2,}", line.strip()) for line in lines.split("\n")]
    return said((row[column], row[column + 1]) for row in rows if len(row) > column + 1)


@in_turn("spec, message, orders", lambda: ROWS)
def test_the_order_stands_at_every_number_and_at_nothing_else(
    spec: Path,
    message: str,
    orders: dict[str, str],
    references: dict[Path, tuple[Reference, Callable[[list[str]], int]]],
    capsys: pytest.CaptureFixture[str],
) -> None:
    site, command = references[spec]
    page = site.page(f"messages/{message}.html").text
    text = site.files[f"messages/{message}.md"]
    assert command(["docs", message]) == 0
    strip, _, fields = capsys.readouterr().out.partition("\nBytes\n")[2].partition("\nFields\n")
    envelope = {"station", "length", "check"}
    own = {part: order for part, order in orders.items() if part not in envelope}
    assert (drawn(page), described(page)) == (orders, own)
    assert listed(text, r"^\| [^|]* \| [^|]* \| ([^|]*) \| ([^|]*) \|$") == orders
    assert listed(text, r"^\| [^|]* \| `([^|]*)` \| ([^|]*) \|") == own
    assert typed(strip, 2) == orders
    assert typed(fields.partition("\nAbout it\n")[0], 0) == own
