"""Runs of `framegen conform --port` on a device in virtual time, and their results."""

import json
from argparse import ArgumentParser
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple

from framegen.conformance import firmware
from framegen.model.model import Model

from tests.factories import compiled_file, first_model
from tests.lines.devices import Observed


class Run(NamedTuple):
    """The exit status, the output, and the bytes written to the port."""

    code: int
    out: str
    err: str
    written: list[bytes]

    @property
    def report(self) -> dict[str, Any]:
        """The output as JSON."""
        found: dict[str, Any] = json.loads(self.out)
        return found

    def step(self, title: str) -> dict[str, Any]:
        return next(step for step in self.report["steps"] if step["title"] == title)

    @property
    def faults(self) -> list[tuple[str, str]]:
        """The failures: the title of each step, and the kind of each fault in it."""
        return [
            (step["title"], fault["kind"])
            for step in self.report["steps"]
            for fault in step["faults"]
        ]


def model_of(file: Path | None = None) -> Model:
    """Return the model of a spec."""
    return first_model() if file is None else compiled_file(file).model


def run(model: Model, line: Any, *words: str, form: str = "json", timeout: float = 0.25) -> Run:
    """Test the device at the end of `line`, a transport with a clock of its own."""
    parser = ArgumentParser()
    firmware.add_arguments(parser)
    arguments = parser.parse_args(["--port", "a line", *words])
    arguments.format, arguments.timeout = form, timeout
    observed = Observed(line)
    out, err = StringIO(), StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        code = firmware.run(model, arguments, connect=lambda *_: observed, clock=line.clock)
    return Run(code, out.getvalue(), err.getvalue(), observed.written)
