"""What libraries do, written down while their runtime moves; removed when that move is whole.

    python -m tests.characterise                    compare with what is written down
    python -m tests.characterise --write            write it down anew
    python -m tests.characterise --texts build/new  write what the rows are digests of

tests/characterised/digests.txt has a line for each protocol and each part of what its library does:
how many rows it has, and the digest of their texts. Where one differs, write the texts here and in
a checkout of the commit that last wrote the file, and compare the two folders. All is asked for as
users ask for it, so that where a module lies makes no difference.
"""

from __future__ import annotations

import argparse
import hashlib
import logging
import sys
import warnings
from itertools import chain, groupby
from logging.handlers import BufferingHandler
from pathlib import Path

from framegen.targets.python.names import names_of

from tests.characterised.shell import HAS_TABLES, alone, command_rows, line_rows, recording_rows
from tests.characterised.surface import surface_rows
from tests.characterised.talks import client_rows, device_rows, session_rows
from tests.characterised.texts import lines, normalised
from tests.characterised.values import error_rows, event_rows, message_rows
from tests.factories import FROZEN, compiled_file, library, library_of, vectors_of
from tests.protocols.specs import FILES

DIGESTS = Path(__file__).parent / "characterised" / "digests.txt"
# What somebody speaks, and what has names and features that nobody has.
SPECS = {
    "busservo": FROZEN["busservo"],
    **FILES,
    **{each.stem: each for each in sorted((Path(__file__).parent / "specs").glob("*.yaml"))},
}


def texts_of(name: str) -> dict[str, str]:
    """Return the texts of all rows of a protocol."""
    compiled = compiled_file(SPECS[name])
    vectors, files = vectors_of(compiled), library_of(SPECS[name])
    model = names_of(compiled.model).library
    with library(files) as made, alone(made, model), warnings.catch_warnings(record=True) as warned:
        logging.getLogger().addHandler(_LOGGED)
        warnings.simplefilter("ignore")
        warnings.filterwarnings("always", r"\w+ is deprecated", DeprecationWarning)
        rows = chain(
            event_rows(made, vectors),
            error_rows(made, vectors),
            message_rows(made, vectors),
            client_rows(made, model),
            session_rows(made, model, vectors),
            device_rows(made, vectors),
            command_rows(made, vectors),
            line_rows(made),
            recording_rows(made, vectors),
            surface_rows(made, files),
        )
        try:
            return {row: normalised(made, lines([text, *_aside(warned)])) for row, text in rows}
        finally:
            logging.getLogger().removeHandler(_LOGGED)


# What is logged anywhere, from warnings on.
_LOGGED = BufferingHandler(10**6)
_LOGGED.setLevel(logging.WARNING)


def _aside(warned: list[warnings.WarningMessage]) -> list[str]:
    """Return what has been logged and warned of since this was asked for last, and forget it."""
    said = [f"{each.name} {each.levelname}: {each.getMessage()}" for each in _LOGGED.buffer]
    said += sorted({f"{each.category.__name__}: {each.message}" for each in warned})
    _LOGGED.buffer.clear()
    warned.clear()
    return said


def digests_of(name: str) -> dict[str, str]:
    """Return the number of rows and the digest of each part of what a library does."""
    found = {}
    for part, rows in groupby(sorted(texts_of(name).items()), lambda row: row[0].partition("/")[0]):
        texts = [f"{row}\n{text}" for row, text in rows]
        data = "\n\n".join(texts).encode("utf-8", "backslashreplace")
        found[f"{name} {part}"] = f"{len(texts)} {hashlib.sha256(data).hexdigest()[:10]}"
    return found


def written() -> dict[str, str]:
    """Return what is written down, by protocol and part."""
    lines_of = (line.split(" ", 2) for line in DIGESTS.read_text("utf-8").splitlines())
    return {f"{name} {part}": digest for name, part, digest in lines_of}


def differing(name: str) -> list[str]:
    """Return the parts of a protocol that are not as they are written down."""
    expected = {part for part in written().items() if part[0].startswith(f"{name} ")}
    if not HAS_TABLES:
        expected = {part for part in expected if not part[0].endswith(" tables")}
    return sorted({part for part, _ in digests_of(name).items() ^ expected})


def main(words: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.characterise")
    parser.add_argument("names", nargs="*", default=[*SPECS], help="protocols (default: all)")
    parser.add_argument("--write", action="store_true", help="write down what they do")
    parser.add_argument("--texts", type=Path, metavar="DIR", help="write the texts into a folder")
    given = parser.parse_args(words)
    status = 0
    for name in given.names:
        if given.texts is not None:
            for row, text in texts_of(name).items():
                file = given.texts / name / f"{row}.txt"
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(f"{text}\n", "utf-8", errors="backslashreplace", newline="\n")
        elif given.write:
            kept = {part: it for part, it in written().items() if not part.startswith(f"{name} ")}
            parts = sorted({**kept, **digests_of(name)}.items())
            text = "".join(f"{part} {digest}\n" for part, digest in parts)
            DIGESTS.write_text(text, "utf-8", newline="\n")
        else:
            for part in differing(name):
                print(f"{part} differs")
                status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
