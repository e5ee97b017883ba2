"""Output of the same text, made once in a process, and without most of what is copied as it is.

The writer takes one file like another, so that these stand for whole libraries.
"""

import re
from functools import cache

import pytest
from framegen.compile import Compiled, compile_spec
from framegen.reading.source import Source
from framegen.render import render_target
from framegen.targets import table
from framegen.targets.target import Target

LEFT_OUT = re.compile(
    r"generated/\w+/_runtime/(?:client|codec|command|explain|frame|recording|tables)/"
)


@cache
def compiled_once(source: Source) -> Compiled:
    return compile_spec(source)


_RENDERED: dict[tuple[object, ...], dict[str, str]] = {}


def rendered_once(target: Target, compiled: Compiled) -> dict[str, str]:
    """Render the same text once: it gives the same files, as test_deterministic.py holds."""
    # A page shows the snippets of all targets.
    targets = tuple(each.name for each in table.TARGETS)
    source = compiled.source
    key = target.name, targets, source.path, source.text, compiled.carries_runtime
    if key not in _RENDERED:
        files = render_target(target, compiled)
        _RENDERED[key] = {it: text for it, text in files.items() if not LEFT_OUT.match(it)}
    return dict(_RENDERED[key])


@pytest.fixture(autouse=True)
def the_same_is_made_once(monkeypatch: pytest.MonkeyPatch) -> None:
    make_once(monkeypatch)


def make_once(patch: pytest.MonkeyPatch) -> None:
    patch.setattr("framegen.commands.spec_argument.compile_spec", compiled_once)
    patch.setattr("framegen.render.render_target", rendered_once)
