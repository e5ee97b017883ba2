"""File names for names of the spec: the one rule that every target uses.

Every system can check them out. A name of the spec consists of ASCII letters, digits and `_`, never
ends in `_` and is short enough for a line of code; two that differ only in capitals are refused
where both would be files. What remains are the names that Windows keeps for devices, with any
extension and however they are capitalised.
"""

from __future__ import annotations

from framegen.language.package_names import DEVICES


def file_stem(name: str) -> str:
    """Return the file name of `name`, without its extension: `Con_` for Con."""
    return f"{name}_" if name.lower() in DEVICES else name
