"""Which files a library is made of: some only if the protocol has a use for them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.targets.python.checksum_view import checksums_of

if TYPE_CHECKING:
    from framegen.targets.python.client_view import ClientView
    from framegen.targets.python.library_view import LibraryView

# What only some protocols have a use for, by what they have; `_used` tells which these are.
ONLY_WITH = {
    "a distribution": {"README.md", "pyproject.toml"},
    "poses": {
        *("_cli/hold.py", "_cli/play.py", "_cli/pose_verb.py", "_cli/posefile.py"),
        *("_cli/positions.py", "_cli/stop.py", "_cli/teach.py"),
    },
    "addresses": {"_client/address.py", "_client/async_devices.py", "_client/devices.py"},
    "failures": {"_client/failures.py"},
    "counted replies": {"_client/counted.py"},
    # Each method needs some of these, and each kind of field some of those.
    "checksums": {
        f"_frame/{name}.py" for name in ("byte_sum", "word_sum", "crc", "fletcher", "running")
    },
    "fields": {
        *("_frame/mixed_element.py", "_frame/three_bytes.py"),
        *("_frame/big.py", "_frame/big_swapped.py", "_frame/big_three_bytes.py"),
        *("_frame/little.py", "_frame/little_swapped.py", "_frame/little_three_bytes.py"),
    },
}


def placed(files: dict[str, str], library: LibraryView, client: ClientView) -> dict[str, str]:
    """Return those of all files that the library has a use for, each in its place."""
    used = _used(library, client)
    unused = set[str]().union(*ONLY_WITH.values()) - used
    return {name: text for name, text in files.items() if name not in unused}


def _used(library: LibraryView, client: ClientView) -> set[str]:
    spec = library.model.spec
    has = {
        "a distribution": spec.protocol.distribution is not None,
        "poses": spec.pose is not None,
        "addresses": client.bus is not None,
        "failures": bool(client.failing),
        "counted replies": any(each.counted for each in library.model.exchanges),
    }
    used = {name for what, there in has.items() if there for name in ONLY_WITH[what]}
    used |= {f"_frame/{name}.py" for name in library.modules}
    methods = [*checksums_of(library.model), *library.lookalike_methods]
    return used.union(*(method.files for method in methods))
