"""Every name that a library binds is a good name for anything in a spec."""

import pytest

from tests.bound_crowds import CROWDS, crowd_of
from tests.factories import compiled_of
from tests.names_at_work import at_work

# Classes meet what modules import, which depends on the kind; tests/all has all others of both.
KINDS = [(kind, at % 2 == 0) for at, kind in enumerate(CROWDS)]
KINDS += [("messages", False), ("elements", True)]


@pytest.mark.parametrize(("kind", "plain"), KINDS)
def test_a_library_works_whatever_its_names_are(kind: str, plain: bool) -> None:
    at_work(compiled_of(crowd_of(kind, plain=plain)))
