"""Characters that ruff takes for others are those that framegen refuses."""

import re
from pathlib import Path

from framegen.targets.python.docstring import docstring
from framegen.targets.python.escape import literal

from tests.side_by_side import linted

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
