"""framegen: makes codecs, a schema, test vectors and documentation of a protocol's spec."""

import sys
from importlib.util import find_spec
from pathlib import Path

__version__ = "0.1.0"

# What libraries have in common is a package of its own. In a clone it comes with the library at
# the root; the package that others get of framegen brings it, for where nothing else does.
if find_spec("framewire") is None:
    sys.path.append(str(Path(__file__).parent / "_runtime"))
