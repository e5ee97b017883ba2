"""framegen: makes codecs, a schema, test vectors and documentation of a protocol's spec."""

import sys
from pathlib import Path

__version__ = "0.1.0"

# What libraries have in common is a package of its own. In a clone it comes with the library at
# the root. The package that others get of framegen brings the one that it was made with, which
# goes before that of any library installed beside it.
_BROUGHT = Path(__file__).parent / "_runtime"
if _BROUGHT.is_dir():
    sys.path.insert(0, str(_BROUGHT))
