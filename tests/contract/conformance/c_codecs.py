"""The codec in C, right and wrong: each wrong one by a small change, as found in public code."""

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.mutations.spec_edits import edited

HERE = Path(__file__).parent
SOURCE = HERE / "codec.c"
COMPILER = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)

# Whoever has no compiler may do without; what is published may not.
needs_compiler = pytest.mark.skipif(
    COMPILER is None and "CI" not in os.environ, reason="no C compiler is installed"
)

NOISE = (
    'else printf("noise %s %02x\\n", reason = have > 1 && !memcmp(p, "UU", 2) ? why : reason, *p);'
)
# As NOISE, of as many bytes as `size` says.
NOISE_OF = (
    'else for (reason = have > 1 && !memcmp(p, "UU", 2) ? why : reason, size = {size}, at = 0; '
    'at < size; at++) printf("noise %s %02x\\n", reason, p[at]);'
)


@dataclass(frozen=True)
class Wrong:
    """A codec with one error: the changed text, what finds it, and the smallest case.

    `parted` is what the reference and the program answer where they differ.
    """

    old: str
    new: str
    caught_by: frozenset[str]
    smallest: str
    parted: tuple[str, str]


def compile_codec(folder: Path, old: str = "", new: str = "") -> str:
    """Compile the codec, with one text replaced; return the program."""
    text = SOURCE.read_text(encoding="utf-8")
    source = folder / "codec.c"
    source.write_text(edited(text, (old, new)) if old else text, encoding="utf-8")
    program = folder / "codec"
    # What other compilers warn of is theirs.
    strict = ["-pedantic", "-Wall", "-Wextra", "-Werror"]
    flags = [*strict, "-O1"] if sys.platform == "linux" and not old else ["-w"]
    subprocess.run(
        [str(COMPILER), "-std=c99", *flags, f"-I{HERE}", "-o", str(program), str(source)],
        check=True,
    )
    return str(program)


def still(count: int) -> str:
    """Return targets that are nothing but zeros."""
    return ",".join(["0:0"] * count)


def move(count: int) -> str:
    """Return the frame of these targets, in hex."""
    return f"5555{3 * count + 5:02x}03{count:02x}0000" + "000000" * count


WRONG = {
    "the length is off by one": Wrong(
        old="p[2] + 2, items, room;",
        new="p[2] + 3, items, room;",
        caught_by=frozenset({"decode", "encode", "stream"}),
        smallest="decode host_to_controller 55550107",
        parted=("refused length-mismatch 2", "message ActionGroupStop 55550107"),
    ),
    "a false header costs the length that it claims": Wrong(
        old=NOISE,
        new=NOISE_OF.format(size='have > 2 && !memcmp(p, "UU", 2) && p[2] < have ? p[2] + 1 : 1'),
        caught_by=frozenset({"stream"}),
        smallest="stream host_to_controller 257 55550355550207",
        parted=("noise unknown-command 555503", "noise unknown-command 55550355550207"),
    ),
    "a false header costs two bytes, so that a stray 55 costs a frame": Wrong(
        old=NOISE,
        new=NOISE_OF.format(size='have > 1 && !memcmp(p, "UU", 2) ? 2 : 1'),
        caught_by=frozenset({"stream"}),
        smallest="stream host_to_controller 257 5555550207",
        parted=("noise unknown-command 55", "noise unknown-command 5555550207"),
    ),
    "numbers are read with their high byte first": Wrong(
        old="each[0] + each[1] * 256",
        new="each[1] + each[0] * 256",
        caught_by=frozenset({"decode", "stream"}),
        smallest="decode host_to_controller 55550803010000000001",
        parted=(
            "message ServoMove 55550803010000000001 time_ms=0 targets=0:256",
            "message ServoMove 55550803010000000001 time_ms=0 targets=0:1",
        ),
    ),
    "the count is not held against the length": Wrong(
        old="found->step && n > 4 && p[4] != items",
        new="0",
        caught_by=frozenset({"decode", "stream"}),
        smallest="decode host_to_controller 55550803000000000000",
        parted=(
            "refused count-mismatch 4",
            "message ServoMove 55550803000000000000 time_ms=0 targets=0:0",
        ),
    ),
    "a frame of unknown command is noise": Wrong(
        old="else if (all && all <= have && !begins(p, all, CUT))",
        new="else if (0)",
        caught_by=frozenset({"stream"}),
        smallest="stream host_to_controller 257 55550200",
        parted=("unknown 55550200", "noise unknown-command 55550200"),
    ),
    "a frame of unknown command takes along what is inside": Wrong(
        old="all <= have && !begins(p, all, CUT)",
        new="all <= have",
        caught_by=frozenset({"stream"}),
        smallest="stream host_to_controller 257 55550255550207",
        parted=("noise unknown-command 555502", "unknown 55550255"),
    ),
    "a frame that is cut stops the line for ever": Wrong(
        old="else if (!quiet && (why == CUT",
        new="else if ((why == CUT",
        caught_by=frozenset({"stream"}),
        smallest="stream host_to_controller 257 555508030100000000 quiet 00",
        parted=("noise too-short 555508030100000000", "quiet"),
    ),
    "what does not fit into 64 bytes is dropped": Wrong(
        old="held[have++] = (byte)x;",
        new="if (have < 64) held[have++] = (byte)x;",
        caught_by=frozenset({"decode", "stream"}),
        smallest=f"decode host_to_controller {move(20)}",
        parted=(
            f"message ServoMove {move(20)} time_ms=0 targets={still(20)}",
            "refused too-short 64",
        ),
    ),
    "a list has room for 32": Wrong(
        old="if (value < 0 || value >> 8 * (*c - '0')) return 0;",
        new="if (value < 0 || value >> 8 * (*c - '0')) return 0; if (p - held > 102) break;",
        caught_by=frozenset({"encode"}),
        smallest=f"encode ServoMove time_ms=0 targets={still(33)}",
        parted=(f"frame {move(33)}", f"frame {move(32)}"),
    ),
}
