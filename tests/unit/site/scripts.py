"""The scripts of the page with the decoder, asked under node; numbers of any size go both ways."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Any

from framegen import site

from tests.unit.site.reference import NODE

if TYPE_CHECKING:
    from collections.abc import Iterable

STATIC = Path(site.__file__).parent / "static" / "js"

# What JSON cannot say goes as an object: {"number": "9007199254740993"}.
_BEGIN = """
const sayable = (key, value) => {
  if (Object.is(value, -0)) return { number: "-0.0" };
  const isOdd = typeof value === "number" && !Number.isFinite(value);
  return typeof value === "bigint" || isOdd ? { number: String(value) } : value;
};
const meant = (key, value) => (typeof value?.number !== "string" ? value
  : /^-?[0-9]+$/.test(value.number) ? BigInt(value.number) : Number(value.number));
const asked = JSON.parse(given, meant);
"""
_END = "console.log(JSON.stringify(answers, sayable));"
_EXACT = 1 << 53


def run_script(names: Iterable[str], program: str, asked: object) -> Any:
    """Run a program behind files of the page; it finds `asked`, and leaves `answers`."""
    files = "\n".join((STATIC / f"{name}.js").read_text("utf-8") for name in names)
    given = f"const given = {json.dumps(json.dumps(_sayable(asked)))};"
    # All of it goes in by the input: an argument has a greatest size.
    done = subprocess.run(
        [str(NODE), "--input-type=commonjs", "-"],
        input=f"{files}\n{given}{_BEGIN}{program}{_END}",
        capture_output=True,
        encoding="utf-8",
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout, object_hook=_meant, parse_int=_whole)


def _sayable(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _sayable(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [_sayable(each) for each in value]
    if isinstance(value, bytes):
        return list(value)
    is_large = isinstance(value, int) and abs(value) > _EXACT
    return {"number": str(value)} if is_large else value


def _whole(digits: str) -> float:
    """Return a number without a point; one of many digits is of floating point, in a script."""
    return int(digits) if abs(int(digits)) <= _EXACT else float(digits)


def _meant(found: dict[str, Any]) -> Any:
    if found.keys() != {"number"} or not isinstance(found["number"], str):
        return found
    text = found["number"].replace("Infinity", "inf")
    return int(text) if text.lstrip("-").isdigit() else float(text)
