"""No character that the library shows as it is, is one that ruff takes for another."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from framegen.targets.python.characters import columns, shown, unbroken
from framegen.targets.python.docstring import docstring
from framegen.targets.python.escape import literal

from tests.contract.libraries import linted

if TYPE_CHECKING:
    from pathlib import Path

# All that a spec may hold, but for emoji and scripts that nobody uses any more.
CHARACTERS = [chr(code) for code in range(0xA0, 0xD800) if chr(code).isprintable()]


def test_ruff_takes_no_character_for_another(tmp_path: Path) -> None:
    """Alone, in a word of ASCII, and in a word of its script, in literals and in docstrings."""
    said = [f"{at} a{at} {at}\u044f" for at in CHARACTERS]
    # A few on a line, of which each word is judged alone.
    few = [" ".join(said[at : at + 3]) for at in range(0, len(said), 3)]
    lines = [f"X{at} = {literal(text)}" for at, text in enumerate(few)]
    blocks = [" ".join(CHARACTERS), " a".join(CHARACTERS), "\u044f ".join(CHARACTERS)]
    package = tmp_path / "odd"
    package.mkdir()
    text = "\n".join([docstring(["Odd.", *blocks], 0, "Odd."), "", *lines, ""])
    (package / "__init__.py").write_text(text, encoding="utf-8", newline="")
    assert linted(tmp_path) == {}
    assert len(re.findall("[^\x00-\x7f]", text)) > 100_000


def test_text_of_a_script_is_shown_in_it() -> None:
    for text in (
        "Öffnet",
        "открыть",
        "Ανοίγει",
        "打开阀门。",
        "ノート",
        "열기",
        "5 µm ± 2 °C ≤ 3 Ω",
    ):
        assert shown(text) == text


def test_a_wide_character_takes_two_columns_and_may_end_a_line() -> None:
    assert columns("打开 ab") == 7
    assert unbroken("打开ab") == ["打", "开", "ab"]
    # Alone on a line, it would be taken for a slash.
    assert unbroken("漢ノ、字") == ["漢ノ、", "字"]
