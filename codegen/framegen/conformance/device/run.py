"""A run from its first step to its last: each is sent, judged and reported."""

from __future__ import annotations

import json
import sys
from itertools import chain
from typing import TYPE_CHECKING

from framegen.conformance.device.judgement import Judgement, judge, judge_reports
from framegen.conformance.device.report import (
    Result,
    as_json,
    closing,
    line_of,
    opening,
    unsolicited,
)
from framegen.conformance.device.step import requests_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from framegen.conformance.device.recording import Recording
    from framegen.conformance.device.report import Report
    from framegen.conformance.device.session import Session
    from framegen.conformance.device.step import Request, Step

# How often a query is sent again to a device that did not answer it behind a malformed frame.
_ATTEMPTS = 8
# So many steps without a single byte tell that nobody is there.
_SILENT_STEPS = 3


class Run:
    """The steps of a run; `after` is the query that shows whether a device still answers."""

    def __init__(
        self, report: Report, session: Session, recording: Recording, after: Request | None
    ) -> None:
        self._report = report
        self._session = session
        self._recording = recording
        self._after = after

    def go(self, steps: Sequence[Step], progress: Progress) -> None:
        """Try all steps, or stop where going on is useless. Raises OSError."""
        if not any(step.seconds for step in steps):
            self._report.unsolicited = self._session.listen().received
        progress.say(unsolicited(self._report))
        for step in steps:
            self._recording.note(step.title)
            result = self._try(step)
            self._report.results.append(result)
            progress.say(line_of(result))
            if self._is_silent():
                self._report.stopped = self._silent()
            if self._report.stopped:
                return

    def _try(self, step: Step) -> Result:
        result = Result(step)
        if step.seconds:
            transcript = self._session.listen(step.seconds)
            judgement = judge_reports(self._report.model, transcript, step.seconds)
            result.bursts.append((transcript, judgement))
            return result
        result.not_sent = self._objection(step)
        for burst in () if result.not_sent else step.bursts:
            transcript = self._session.send(burst)
            result.bursts.append((transcript, judge(self._report.model, transcript)))
            if not result.has_passed:
                break
        if step.is_malformed and not result.has_passed:
            self._recover(result)
        return result

    def _objection(self, step: Step) -> str:
        """Return why a step must not be sent, by itself or with a query behind it."""
        if self._has_echo() and any(len(requests_of(burst)) > 1 for burst in step.bursts):
            return "the line gives back what is sent, and so carries one thing at a time"
        behind = () if self._after is None else (self._after,)
        return self._session.objection(tuple(chain(*step.bursts, behind)))

    def _recover(self, result: Result) -> None:
        """Send a query until it is answered: a device may still wait for the rest of a frame."""
        if self._after is None or self._session.objection((self._after,)):
            return
        name = self._after.message.name
        for attempt in range(1, _ATTEMPTS + 1):
            transcript = self._session.send((self._after,))
            result.bursts.append((transcript, Judgement()))
            if judge(self._report.model, transcript).seconds:
                again = "the next" if attempt == 1 else f"number {attempt} behind it"
                result.notes.append(f"{name} is answered again: {again}")
                return
        self._report.stopped = (
            f"{name} is not answered any more, {_ATTEMPTS} times: switch the device off and on"
        )

    def _has_echo(self) -> bool:
        results = self._report.results
        return any(judgement.has_echo for result in results for _, judgement in result.bursts)

    def _silent(self) -> str:
        what = "nothing comes at all: is the device switched on, and is this its port?"
        permission = self._session.permission
        if permission.address is None or permission.device is not None:
            return what
        return f"{what} If it has another {permission.address.name}, name it by --address"

    def _is_silent(self) -> bool:
        results = [result for result in self._report.results if result.bursts]
        anything = any(transcript.received for result in results for transcript, _ in result.bursts)
        return len(results) >= _SILENT_STEPS and not anything


class Progress:
    """The printed progress of a run; as JSON, everything is printed at the end."""

    def __init__(self, *, as_json: bool) -> None:
        self._as_json = as_json

    def begin(self, report: Report, steps: Sequence[Step]) -> None:
        """Print what will be sent, before anything is."""
        stream = sys.stderr if self._as_json else sys.stdout
        for line in opening(report, steps):
            print(line, file=stream)
        stream.flush()

    def say(self, lines: Iterable[str]) -> None:
        """Print what has happened."""
        if not self._as_json:
            for line in lines:
                print(line)
            sys.stdout.flush()

    def end(self, report: Report) -> None:
        """Print the results."""
        if self._as_json:
            print(json.dumps(as_json(report)))
        else:
            self.say(closing(report))
