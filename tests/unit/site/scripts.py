"""The scripts of the pages, asked under Node; numbers of any size go both ways.

One process answers all tests of a worker: what a script leaves behind is gone with its function.
"""

import atexit
import json
import subprocess
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

from framegen import site
from framegen.site.scripts.line_data import LINE_SCRIPT

from tests.unit.site.reference import NODE

STATIC = Path(site.__file__).parent / "static" / "js"
# What talks over a line, but for what touches the page.
_PANEL = ("serial_settings", "serial_file", "serial_log", "serial_panel")
SESSION = [name for name in LINE_SCRIPT if name not in _PANEL]
HOST = Path(__file__).with_name("script_host.js")

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
_END = "return JSON.stringify(await answers, sayable);"
_EXACT = 1 << 53


def run_script(names: Iterable[str], program: str, asked: object, *others: str) -> Any:
    """Run a program behind files of the page, and other scripts; it finds `asked`.

    It leaves `answers`, or a promise of them; what the next one shall have, too, is in `kept`.
    """
    texts = [(STATIC / f"{name}.js").read_text("utf-8") for name in names]
    text = "\n".join([*texts, *others, _BEGIN, program, _END])
    question = {"text": text, "given": json.dumps(_sayable(asked))}
    said = json.loads(_answer(json.dumps(question)))
    if said.get("isEnd"):
        node().wait()
        node.cache_clear()
    assert "failure" not in said, said["failure"]
    return json.loads(said["answer"], object_hook=_meant, parse_int=_whole)


def _answer(question: str) -> str:
    process = node()
    assert process.stdin is not None
    assert process.stdout is not None
    process.stdin.write(f"{question}\n")
    process.stdin.flush()
    return process.stdout.readline()


@cache
def node() -> subprocess.Popen[str]:
    """Return the process of this worker, or the next one, where a program has ended that."""
    process = subprocess.Popen(
        [str(NODE), str(HOST)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8"
    )
    atexit.register(process.communicate)
    return process


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
