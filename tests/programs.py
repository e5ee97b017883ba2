"""Programs that run in a process of their own, to their end."""

import os
import subprocess
from collections.abc import Mapping
from typing import Any

from tests.timeouts import GENEROUS


def ran(
    *words: object,
    status: int | None = 0,
    environment: Mapping[str, str] | None = None,
    **options: Any,
) -> subprocess.CompletedProcess[str]:
    """Run a program, and return what it printed; any other exit status than this is a failure.

    With None, every status will do. `environment` is what it has besides the variables of the
    tests; all else is as for `subprocess.run`.
    """
    given = {
        "env": {**os.environ, **(environment or {})},
        "capture_output": True,
        "encoding": "utf-8",
        "timeout": 5 * GENEROUS,
        **options,
    }
    done = subprocess.run([*map(str, words)], check=False, **given)
    assert status in (None, done.returncode), f"{words}\n{done.stdout}\n{done.stderr}"
    return done
