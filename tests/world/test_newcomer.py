"""README and getting-started work from a new clone on, with the system's own Python."""

import shutil

import pytest

from tests.documents import ROOT
from tests.programs import ran


@pytest.mark.skipif(shutil.which("git") is None, reason="there is no git here")
def test_the_pages_work_on_a_fresh_machine() -> None:
    command = ["bash", str(ROOT / ".ci" / "newcomer")]
    done = ran(*command, status=None, timeout=None)
    if done.returncode == 2:
        pytest.skip(done.stderr.strip())
    assert done.returncode == 0, done.stdout + done.stderr
