"""What the verbs with a port share: how it is named, and what is shown when it fails."""

from __future__ import annotations

from contextlib import contextmanager

from ..link_errors import TransportError
from .unusable import UnusableError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser
    from collections.abc import Iterator


def add_port(parser: ArgumentParser) -> None:
    """Declares the option that names the port."""
    parser.add_argument(
        "--port",
        required=True,
        metavar="PORT",
        help="such as /dev/ttyUSB0, COM7 or socket://HOST:PORT; `ports` lists them",
    )


@contextmanager
def failures_told() -> Iterator[None]:
    """Turns what goes wrong with a port into one line that says what to do."""
    try:
        yield
    except TransportError as error:
        raise UnusableError(str(error)) from None
