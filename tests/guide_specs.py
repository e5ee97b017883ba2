"""The specs that the guide to the spec language shows, put together from its blocks."""

import re
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from framegen.reading.source import Source

GUIDE = (Path(__file__).parents[1] / "docs" / "write-a-spec.md").read_text("utf-8")
# A block of another spec than the kiln's begins with its name.
BLOCKS = re.findall(r"```yaml\n(?:# (\w+)\.yaml\n)?(.*?)```", GUIDE, re.DOTALL)
NAMES = list(dict.fromkeys(name or "kiln" for name, _ in BLOCKS))
SPECS = {
    each: Source(
        f"spec/{each}.yaml", "\n".join(text for name, text in BLOCKS if (name or "kiln") == each)
    )
    for each in NAMES
}

# It is there as long as the tests are.
_FOLDER = TemporaryDirectory(prefix="guide-specs-")


@cache
def file_of(name: str) -> Path:
    """Return a file with one of the specs."""
    file = Path(_FOLDER.name) / f"{name}.yaml"
    file.write_text(SPECS[name].text, "utf-8", newline="\n")
    return file
