"""Errors of a live line: the port itself, a reply or a report that does not come."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ..frame.errors import ProtocolError
from ..frame.message import Message
from ..frame.pluralize import pluralize

TYPE_CHECKING = False
if TYPE_CHECKING:
    import typing_extensions as typing
else:
    from ..frame.typing_later import typing

# How many reports the text of an error names.
_SHOWN = 4


def errno_of(error: Exception) -> int | None:
    """Return the number that the system has for an error; None where it has none."""
    number = getattr(error, "errno", None)
    return number if isinstance(number, int) else None


class TransportError(ProtocolError, OSError):
    """The port failed. `port` is its name, `happened` what happened, `advice` what to do.

    As of any OSError, `filename` is the port, `strerror` what happened, and `errno` the number that
    the system has for it, None where it has none.
    """

    def __init__(self, port: str, happened: str, advice: str, errno: int | None = None) -> None:
        super().__init__(errno, happened, port)
        self.port = port
        self.happened = happened
        self.advice = advice

    def __str__(self) -> str:
        return f"{self.port}: {self.happened}; {self.advice}"

    def __reduce__(self) -> tuple[object, ...]:
        given = self.port, self.happened, self.advice, self.errno
        return type(self), given, vars(self)

    def again(self) -> typing.Self:
        """Return a copy of the error, to be raised once more, with no traceback of its own yet."""
        return type(self)(self.port, self.happened, self.advice, self.errno)


class PortNotFoundError(TransportError):
    """There is no such port."""


class PortBusyError(TransportError):
    """Another program has the port."""


class PortPermissionError(TransportError):
    """The user may not use the port."""


class PortAddressError(TransportError, ValueError):
    """The given name is neither a port's, nor a URL of any known kind."""


class DisconnectedError(TransportError):
    """The line was lost: a cable pulled, a device gone, the other end hung up."""


class WriteStuckError(TransportError):
    """The port takes no more bytes."""


class ClosedError(TransportError):
    """The line has been closed at this end."""


class EchoError(TransportError):
    """The echo of a frame has not come, on a line that was said to have a local echo."""


class NoReplyError(ProtocolError, TimeoutError):
    """No reply came in time. `request` is the message sent, `waited` the seconds spent on it.

    What came instead meanwhile: `noise` bytes that are no frame, `reports`, and `unsolicited`
    replies, which cannot be the answer.
    """

    def __init__(
        self,
        request: Message,
        reply: str,
        waited: float,
        attempts: int = 1,
        noise: int = 0,
        reports: int = 0,
        unsolicited: int = 0,
    ) -> None:
        super().__init__(request, reply, waited, attempts, noise, reports, unsolicited)
        self.request = request
        self.reply = reply
        self.waited = waited
        self.attempts = attempts
        self.noise = noise
        self.reports = reports
        self.unsolicited = unsolicited

    def __str__(self) -> str:
        tries = f" to {self.attempts} requests" if self.attempts > 1 else ""
        problem = f"no {self.reply} came within {self.waited:.3f} s{tries} of {self.request!r}"
        came = what_came(self.noise, self.reports, self.unsolicited)
        return f"{problem}; {came}"


def what_came(noise: int, reports: int, unsolicited: int) -> str:
    """Say what came in place of a reply, and what that hints at."""
    came: list[str] = []
    if noise:
        verb = "is" if noise == 1 else "are"
        came.append(f"{pluralize(noise, 'byte')} came that {verb} no frame: wrong baud rate?")
    if unsolicited:
        replies = pluralize(unsolicited, "reply", "replies")
        came.append(f"{replies} came that cannot be the answer: late, or sent twice")
    if reports:
        came.append(f"{pluralize(reports, 'report')} came, so the device can be heard")
    return "; ".join(came) or (
        "nothing came at all: is the device switched on, and is this its port?"
    )


class DoubtfulReplyError(NoReplyError):
    """Replies came that differ, and nothing shows which of them is the answer, if one is.

    They are in `replies`. A question that was only to be confirmed is not repeated for that: what
    it asks for may have been done.
    """

    def __init__(
        self, request: Message, replies: Iterable[Message], waited: float, attempts: int = 1
    ) -> None:
        self.replies = tuple(replies)
        kind = type(self.replies[-1]).__name__
        super().__init__(request, kind, waited, attempts, unsolicited=len(self.replies))

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.request, self.replies, self.waited, self.attempts), vars(self)

    def __str__(self) -> str:
        tries = f" to {self.attempts} requests" if self.attempts > 1 else ""
        came = " and ".join(f"{reply!r}" for reply in self.replies)
        return (
            f"{came} came within {self.waited:.3f} s{tries} of {self.request!r}, and nothing shows "
            "which is the answer; one may be late, or two devices answer: ask again"
        )


class IncompleteReplyError(ProtocolError):
    """A reply held less than was requested.

    `missing` is what was requested and not received, by its `field`, `arrived` what was received
    (such as positions), and `replies` the messages that held it.
    """

    def __init__(
        self,
        field: str,
        missing: Iterable[int],
        replies: Iterable[Message],
        arrived: Iterable[object],
    ) -> None:
        self.field = field
        self.missing = tuple(missing)
        self.replies = tuple(replies)
        self.arrived = tuple(arrived)
        super().__init__(field, self.missing, self.replies, self.arrived)

    def __str__(self) -> str:
        missing = ", ".join(str(number) for number in self.missing)
        return f"nothing was reported of {self.field} {missing}; {len(self.arrived)} did arrive"


class AbsentError(IncompleteReplyError):
    """Some of those that were to be held are switched off or missing, so that nothing was sent."""

    def __str__(self) -> str:
        missing = ", ".join(str(number) for number in self.missing)
        return (
            f"nothing was sent, since these are off or missing: {self.field} {missing}; "
            f"{len(self.arrived)} did arrive"
        )


class NotHeldError(ProtocolError):
    """Not everything that a client was to hold, or to let go of, as it was closed was reached.

    `left` has the number of each that was not, and why; `what` is what they are and what was to
    become of them, in words.
    """

    def __init__(self, what: str, left: Mapping[int, str]) -> None:
        super().__init__(what, left)
        self.what = what
        self.left = dict(left)

    def __str__(self) -> str:
        reasons = dict.fromkeys(self.left.values())
        parts = [
            f"{', '.join(str(each) for each, of in self.left.items() if of == why)} ({why})"
            for why in reasons
        ]
        return f"{self.what}: {'; '.join(parts)}"


class NoReportError(ProtocolError, TimeoutError):
    """A report did not come. `report` is the expected one, `waited` how many seconds.

    `instead` has the reports that came in its place, and how often each of them did.
    """

    def __init__(
        self, report: str, waited: float, instead: Mapping[Message, int] | None = None
    ) -> None:
        self.report = report
        self.waited = waited
        self.instead = {} if instead is None else dict(instead)
        # Without these: a TimeoutError would take the first for the number that the system has.
        super().__init__()

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.report, self.waited, self.instead), vars(self)

    def __str__(self) -> str:
        came = [
            f"{message!r}" if count == 1 else f"{count} times {message!r}"
            for message, count in self.instead.items()
        ]
        # The latest ones say most about what goes on now.
        more = [f"{len(came) - _SHOWN} others"] if len(came) > _SHOWN else []
        what = ", ".join([*more, *came[-_SHOWN:]]) or "no report at all"
        return f"no {self.report} came within {self.waited:.3f} s; what came instead: {what}"
