"""`python -m lxservo_simulator` is the command `lxservo simulate`."""

import sys

from lxservo_simulator.cli import main

if __name__ == "__main__":
    sys.exit(main())
