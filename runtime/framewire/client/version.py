"""The version of a library: of the installed package, or else of its specification."""

from __future__ import annotations

import json
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

TYPE_CHECKING = False
if TYPE_CHECKING:
    from importlib.metadata import Distribution


def version_of(folder: Path, otherwise: str) -> str:
    """Return the version of the package in `folder`; a copy of an installed package has none."""
    try:
        installed = distribution(folder.name)
    except PackageNotFoundError:
        return otherwise
    return installed.version if _is_of(installed, folder) else otherwise


def _is_of(installed: Distribution, folder: Path) -> bool:
    if Path(str(installed.locate_file(folder.name))).resolve() == folder.resolve():
        return True
    # Installed to be edited, it has no files of its own, and says where the project is.
    origin = json.loads(installed.read_text("direct_url.json") or "{}")
    editable = origin.get("dir_info", {}).get("editable", False)
    above = [*folder.parents, *folder.resolve().parents]
    return editable and origin.get("url") in {each.as_uri() for each in above}
