"""README and getting-started work from a new clone on, with the system's own Python."""

import shutil
import subprocess

import pytest

from tests.documents import ROOT


@pytest.mark.skipif(shutil.which("git") is None, reason="there is no git here")
def test_the_pages_work_on_a_fresh_machine() -> None:
    command = ["bash", str(ROOT / ".ci" / "newcomer")]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    if done.returncode == 2:
        pytest.skip(done.stderr.strip())
    assert done.returncode == 0, done.stdout + done.stderr
