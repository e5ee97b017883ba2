"""Run the package as a program: the same as its command."""

import sys

from ._cli import main

if __name__ == "__main__":
    sys.exit(main())
