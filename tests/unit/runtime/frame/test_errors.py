"""The errors of the library: one tree, named as users import it, and true as errors of Python's."""

import errno
import inspect
import sys
from collections.abc import Iterator
from copy import copy
from typing import Any

import busservo
import framewire
import lxservo
import pytest
from busservo import ProtocolError, TransportError
from framewire.line.port_errors import not_opened

from tests.in_turn import in_turn
from tests.programs import ran
from tests.unit.runtime.frame.copies import pickled

# What Python's own handlers catch of them: the sentence of the README, error by error.
FAMILIES = {
    "": "ProtocolError IncompleteReplyError AbsentError NotHeldError",
    "ValueError": "EncodeError LimitError DecodeError",
    "OSError": "TransportError PortNotFoundError PortBusyError PortPermissionError "
    "DisconnectedError WriteStuckError ClosedError EchoError",
    "ValueError OSError": "PortAddressError",
    "OSError TimeoutError": "NoReplyError DoubtfulReplyError NoReportError",
}
PORT = ("/dev/ttyUSB0", "it is in use", "close the other program")
ASK, VOLTAGES = busservo.BatteryVoltageRead(), [*map(busservo.BatteryVoltage, (1, 2))]
STOP, STOPPED = busservo.ActionGroupStop(), busservo.ActionGroupStopped()


def exported() -> list[type[ProtocolError]]:
    public = (getattr(busservo, name) for name in busservo.__all__)
    return [kind for kind in public if inspect.isclass(kind) and issubclass(kind, ProtocolError)]


LINE_ERRORS = [kind for kind in exported() if issubclass(kind, TransportError)]
ERRORS: list[ProtocolError] = [
    ProtocolError("anything"),
    busservo.EncodeError("targets[1].position", 70000, "70000 is outside 0..65535"),
    busservo.LimitError("targets[1].position", 1200, (0, 1000), "give `limits`"),
    busservo.DecodeError(busservo.Reason.TOO_SHORT, 3, "the shortest frame has 4 bytes"),
    *(kind(*PORT) for kind in LINE_ERRORS),
    *(kind(*PORT, errno.EBUSY) for kind in LINE_ERRORS),
    busservo.NoReplyError(ASK, "BatteryVoltage", 0.25, attempts=2, noise=3),
    busservo.DoubtfulReplyError(ASK, VOLTAGES, 0.3),
    busservo.NoReportError("ActionGroupStarted", 1.5, {STOPPED: 2}),
    busservo.IncompleteReplyError("servo_id", [3], [STOP], [1, 2]),
    busservo.AbsentError("servo_id", [3], [], []),
    busservo.NotHeldError("servos not held", {3: "no answer"}),
]
each_error = in_turn("error", lambda: ERRORS, ids=lambda error: type(error).__name__)


def test_every_error_has_its_family() -> None:
    assert {*exported()} == {type(error) for error in ERRORS}
    found: dict[str, set[str]] = {}
    for kind in exported():
        caught = [each for each in (ValueError, OSError, TimeoutError) if issubclass(kind, each)]
        found.setdefault(" ".join(each.__name__ for each in caught), set()).add(kind.__name__)
    assert found == {caught: {*names.split()} for caught, names in FAMILIES.items()}


@each_error
def test_an_error_is_named_as_it_is_imported(error: ProtocolError) -> None:
    kind = type(error)
    assert kind.__module__ == "framewire"
    assert getattr(framewire, kind.__name__) is getattr(busservo, kind.__name__) is kind


def below(kind: type[ProtocolError]) -> Iterator[type[ProtocolError]]:
    yield kind
    for each in kind.__subclasses__():
        yield from below(each)


def test_every_error_is_named_by_the_runtime() -> None:
    for name in framewire.__all__:
        assert getattr(framewire, name).__name__ == name
    ours = {kind.__name__ for kind in below(ProtocolError) if kind.__module__ == "framewire"}
    assert ours == {*framewire.__all__}
    for library in (busservo, lxservo):
        shared = [name for name in framewire.__all__ if hasattr(library, name)]
        assert len(shared) > 15
        assert [getattr(library, name) for name in shared] == [
            getattr(framewire, name) for name in shared
        ]
    with pytest.raises(AttributeError, match="has no attribute 'NoSuchError'"):
        _ = framewire.NoSuchError  # type: ignore[attr-defined]


def test_an_error_of_somebody_else_keeps_its_name() -> None:
    class CableError(TransportError):
        """The cable of somebody's own transport."""

    assert CableError.__module__ == __name__


def test_a_traceback_names_the_package_though_nothing_was_imported_from_it() -> None:
    code = "from busservo._codec import decode\ndecode(b'', None)"
    done = ran(sys.executable, "-c", code, status=1)
    assert done.stderr.splitlines()[-1].startswith("framewire.DecodeError: too short")


@each_error
def test_an_error_can_be_copied_and_pickled(error: Any) -> None:
    for twin in (copy(error), *pickled(error)):
        assert type(twin) is type(error)
        assert str(twin) == str(error)
        assert vars(twin) == vars(error)
        if isinstance(error, OSError):
            copied = twin.errno, twin.strerror, twin.filename
            assert copied == (error.errno, error.strerror, error.filename)


@in_turn("number", lambda: [None, errno.EBUSY])
@in_turn("kind", lambda: LINE_ERRORS)
def test_an_error_of_the_line_is_an_error_of_the_system(kind: Any, number: int | None) -> None:
    error: TransportError = kind(*PORT, number)
    for each in (error, error.again()):
        assert (each.errno, each.strerror, each.filename) == (number, PORT[1], PORT[0])
        assert str(each) == "/dev/ttyUSB0: it is in use; close the other program"


@in_turn("error", lambda: [each for each in ERRORS if isinstance(each, TimeoutError)])
def test_an_error_for_what_did_not_come_has_no_number_and_no_file(error: OSError) -> None:
    assert (error.errno, error.strerror, error.filename) == (None, None, None)


@in_turn(
    "number, kind",
    lambda: [
        (errno.EACCES, busservo.PortPermissionError),
        (errno.EBUSY, busservo.PortBusyError),
        (errno.ENOENT, busservo.PortNotFoundError),
        (errno.EISDIR, busservo.PortAddressError),
        (errno.EIO, TransportError),
    ],
)
def test_the_number_of_the_system_is_kept(number: int, kind: type[TransportError]) -> None:
    error = not_opened("/dev/ttyUSB0", OSError(number, "the system's words"), str, baud=9600)
    assert type(error) is kind
    assert error.errno == number
    assert error.filename == "/dev/ttyUSB0"
