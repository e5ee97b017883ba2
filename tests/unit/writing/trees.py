"""Small output to write, and the contents of a folder."""

import hashlib
import os
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

from framegen.output import Output, banner
from framegen.vendored import RECORD, record
from framegen.writing.workshop import NAME

Snapshot: TypeAlias = dict[str, bytes | None]

SPEC = "spec/kiln.yaml"
BANNER = f"# {banner(SPEC)}\n"
LIBRARY = "generated/kiln"
PAGES = "docs/reference/kiln"
BROUGHT = f"{LIBRARY}/_runtime"


def snapshot(folder: Path) -> Snapshot:
    """Return every path below `folder`: the bytes of files, None for folders."""
    found: Snapshot = {}
    for above, folders, files in os.walk(folder):
        inner = Path(above).relative_to(folder)
        start = f"{inner.as_posix()}/" if inner.parts else ""
        found |= {f"{start}{name}": None for name in folders}
        for name in files:
            with open(f"{above}/{name}", "rb") as file:  # noqa: PTH123 - many thousands of times
                found[f"{start}{name}"] = file.read()
    return dict(sorted(found.items()))


def without_workshop(found: Snapshot) -> Snapshot:
    return {path: data for path, data in found.items() if path.split("/")[0] != NAME}


def times(folder: Path) -> dict[str, int]:
    return {
        path: Path(path).stat().st_mtime_ns
        for above, _, files in os.walk(folder)
        for path in (str(Path(above, name)) for name in files)
    }


def output(name: str = "kiln", spec: str = SPEC, **bodies: str) -> Output:
    """Return the output of a spec: a module for each body, and a page for each named as a class."""
    files = {}
    for body, text in bodies.items():
        if body[0].isupper():
            files[f"docs/reference/{name}/messages/{body}.md"] = f"<!-- {banner(spec)} -->\n{text}"
        else:
            files[f"generated/{name}/{body.replace('__', '/')}.py"] = f"# {banner(spec)}\n{text}"
    return Output(
        f"generated/{name}.manifest",
        spec,
        files,
        (f"generated/{name}", f"docs/reference/{name}"),
        hashlib.sha256(repr(bodies).encode()).hexdigest(),
    )


def bringing(made: Output, **bodies: str) -> Output:
    """Return output with a folder of what is brought as it is, and recorded there."""
    brought = {f"{body.replace('__', '/')}.py": text for body, text in bodies.items()}
    recorded = {**brought, RECORD: record(brought)}
    return replace(made, files=made.files | {f"{BROUGHT}/{it}": recorded[it] for it in recorded})


def schema(text: str = "{}\n") -> Output:
    return Output("spec/framegen.manifest", "", {"spec/framegen.schema.json": text})


def put(root: Path, path: str, text: str) -> Path:
    """Write a file as somebody else would."""
    file = root / path
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(text.encode("utf-8", errors="surrogateescape"))
    return file


# Two editions that differ in every way: files that come, go, change and stay, and whole folders.
BEFORE = output(
    same="x = 1\n", changed="x = 1\n", gone="x = 1\n", old__inner="x = 1\n", Heat="old", Cool="cool"
)
AFTER = output(
    same="x = 1\n", changed="x = 2\n", new="x = 1\n", deep__er__new="x = 1\n", Heat="new", Fan="fan"
)
# The same with what is brought as it is, in an older version and in a newer.
OLDER = bringing(BEFORE, same="y = 1\n", changed="y = 1\n", old__gone="y = 1\n")
NEWER = bringing(AFTER, same="y = 1\n", changed="y = 2\n", new="y = 1\n")
# The library under another name: whole folders and a manifest go.
RENAMED = output("furnace", SPEC, same="x = 1\n", Heat="new")
