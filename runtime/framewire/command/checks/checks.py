"""All checks, in the order of the guide to troubleshooting, and how they are run."""

from __future__ import annotations

from ...line.link_errors import TransportError
from . import (
    busy,
    echo,
    hid_device,
    look_alike,
    opening,
    permission,
    port_listed,
    reply,
    round_trip,
    silence,
)
from .present import present_check
from .question import harmless_question
from .rate import rate_check
from .result import FAILED, failed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from ...client.library import Library
    from .check import Check
    from .diagnosis import Diagnosis
    from .result import Result

_OF_REPLIES = (echo.CHECK, reply.CHECK, round_trip.CHECK)


def checks_of(library: Library) -> tuple[Check, ...]:
    """Return all checks that there are in a protocol."""
    question, pose = harmless_question(library), library.pose
    return (
        port_listed.CHECK,
        hid_device.CHECK,
        permission.CHECK,
        busy.CHECK,
        opening.CHECK,
        silence.CHECK,
        # Without a question that suits any device, there is no reply to look at.
        *(() if question is None else (rate_check(question), *_OF_REPLIES)),
        *(() if pose is None else (present_check(pose),)),
        look_alike.CHECK,
    )


def examine(diagnosis: Diagnosis, checks: Iterable[Check]) -> Iterator[tuple[Check, Result]]:
    """Make one check after the other, and yield each with its result.

    The port is closed when this ends, however it does.
    """
    blocked: dict[str, str] = {}
    try:
        for check in checks:
            reason = next((blocked[need] for need in check.needs if need in blocked), None)
            if reason is not None:
                blocked[check.id] = reason
                yield check, unknown(f"not looked at: see the check `{reason}`")
                continue
            result = _looked(check, diagnosis)
            if result.state == FAILED:
                blocked[check.id] = check.id
            if diagnosis.lost:
                blocked["opening"] = check.id
            yield check, result
    finally:
        diagnosis.close()


def _looked(check: Check, diagnosis: Diagnosis) -> Result:
    try:
        return check.look(diagnosis)
    except TransportError as error:
        # The library would say `reconnect()`, which cannot be done here.
        diagnosis.lost = True
        advice = "check the cable and the power, then run this again"
        return failed(f"{error.port}: {error.happened}", advice)
