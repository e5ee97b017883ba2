"""`python -m framegen`: the same as the `framegen` command."""

import sys

from framegen.cli import main

if __name__ == "__main__":
    sys.exit(main())
