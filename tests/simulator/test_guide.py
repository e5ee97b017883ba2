"""The guide docs/test-your-robot.md: every piece of Python in it is run."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path

import busservo
import pytest

from tests.patience import PATIENCE

GUIDE = Path(__file__).parents[2] / "docs" / "test-your-robot.md"
BLOCKS = re.findall(
    r"^```python\n(.*?)^```$", GUIDE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE
)


def test_the_guide_has_examples() -> None:
    assert len(BLOCKS) == 7


# Those that look for a reason why something was refused have sent it on purpose.
SHOWN = [
    pytest.param(block, marks=[pytest.mark.garbage] * ("rejects.total == 1" in block))
    for block in BLOCKS
]


@pytest.mark.parametrize("block", SHOWN)
def test_an_example_does_what_it_says(block: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # A guide need not say that a machine may be busy.
    patient = partial(busservo.open_controller, margin=PATIENCE)
    monkeypatch.setattr(busservo, "open_controller", patient)
    names: dict[str, object] = {"__name__": "guide"}
    exec(compile(block, str(GUIDE.name), "exec"), names)  # noqa: S102 - the guide is ours
