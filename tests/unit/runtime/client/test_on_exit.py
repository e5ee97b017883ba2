"""What becomes of what moves, as a client is closed: it is held, released, or left to itself."""

import asyncio
import inspect
import math
import sys
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import lxservo
import pytest
from busservo import (
    AsyncController,
    ClosedError,
    Controller,
    DisconnectedError,
    Message,
    NoReplyError,
    NotHeldError,
    ServoMove,
    ServoPositions,
    ServoPositionsRead,
    ServoUnload,
    open_async_controller,
)
from busservo_simulator import VirtualController
from framewire.client.line_threads import LineThreads

from tests.factories import DEMO, library, library_of
from tests.in_turn import in_turn
from tests.lines.both_clients import TALKS, Talk
from tests.lines.live_line import LiveLine
from tests.lines.receiving import unanswered
from tests.lines.timed_line import client_of, client_on
from tests.lines.virtual_line import VirtualLine, client, in_virtual_time, run
from tests.timeouts import GENEROUS, LIVE

# Where the servos are: on their way, outside the limits, or off.
THERE = {1: 433, 2: 612, 3: 1500, 4: 65535}
LONG = 5000


def where(message: Message) -> list[Message]:
    if isinstance(message, ServoPositionsRead):
        return [ServoPositions([(each, THERE[each]) for each in message.servo_ids])]
    return []


class Stopped(BaseException):
    """What ends a body, as Ctrl-C does."""


Step = Any  # of a body: what is done with the controller and the line, to be awaited or not


def move(*servos: int, **how: bool) -> Step:
    return lambda controller, _: controller.move_servos([(n, 900) for n in servos], LONG, **how)


def release(*servos: int) -> Step:
    return lambda controller, _: controller.unload_servos(servos)


def lose(_controller: object, line: Any) -> None:
    line.unplug()


def stop(*_: object) -> None:
    raise Stopped


def held(*targets: tuple[int, int], asked: tuple[int, ...] | None = None) -> list[Message]:
    asked = tuple(number for number, _ in targets) if asked is None else asked
    return [ServoPositionsRead(asked), ServoMove(100, targets)]


class Case(NamedTuple):
    """A body, what is sent after it, whom the error names, and what the client is made with."""

    about: str
    body: list[Step]
    sent: Sequence[Message]
    left: dict[int, str] | None = None
    cause: type[Exception] | None = None
    given: dict[str, Any] = {}  # noqa: RUF012 - nobody changes it
    answer: Callable[[Message], list[Message]] = where


UNLOAD, NAMED = {"on_exit": "unload"}, {"ids": (2, 1)}
BEYOND, SILENT, LOST = "it is outside 1..253", "no answer", "the line was lost"
NO_ANSWER = [ServoPositionsRead([1])] * 3
STREAM = [move(1, latest=True)] * 5, [ServoMove(LONG, [(1, 900)]), *held((1, 433))]
OUTSIDE, OWN = {3: "1500 is outside the limits"}, {"limits": {3: (500, 2500)}}
LATE: Any = {"given": {"reply_timeout": 60.0}, "answer": unanswered}
CASES = [
    Case("what was moved is held where it is", [move(1, 2)], held((1, 433), (2, 612))),
    Case("nothing was moved, so nothing is sent", [], []),
    Case("whoever is not to be held goes on", [move(1)], [], given={"on_exit": None}),
    Case("what was moved is released", [move(1, 2)], [ServoUnload([1, 2])], given=UNLOAD),
    Case("what is released already stays so", [move(1, 2), release(1)], held((2, 612))),
    Case("it is released no second time", [move(1), release(1)], [], given=UNLOAD),
    Case("it is held if moved again", [release(1), move(1)], held((1, 433))),
    Case("whoever is named is held too", [move(1)], held((2, 612), (1, 433)), given=NAMED),
    Case("it needs no move", [], held((2, 612)), given={"ids": (2,)}),
    Case("the last of a stream goes before", *STREAM),
    Case("outside the limits, one is named", [move(3, 1)], held((1, 433), asked=(3, 1)), OUTSIDE),
    Case("each has its own limits", [move(3, 1)], held((3, 1500), (1, 433)), given=OWN),
    Case("one that is off is named", [move(4, 2)], held((2, 612), asked=(4, 2)), {4: SILENT}),
    Case("all may be off", [move(4)], [ServoPositionsRead([4])], {4: SILENT}),
    Case("nobody answers for all", [move(254, 1)], held((1, 433)), {254: BEYOND}),
    Case("and of these alone, none is", [move(254)], [], {254: BEYOND}),
    Case(
        "it is asked three times", [move(1)], NO_ANSWER, {1: SILENT}, NoReplyError, {}, unanswered
    ),
    Case("but not for ever", [move(1)], NO_ANSWER[:1], {1: "there was no time"}, **LATE),
    Case("a lost line", [move(1, 2), lose], [], {1: LOST, 2: LOST}, DisconnectedError),
    Case("a lost line frees nobody", [move(1), lose], [], {1: LOST}, DisconnectedError, UNLOAD),
]


def carried_out(case: Case, talk: Talk) -> BaseException | None:
    """Return the error that came out of the client; what it sent, and in what time, is as told."""
    line = VirtualLine(case.answer)
    error, count, began = None, 0, 0.0

    async def work(controller: Any) -> None:
        nonlocal count, began
        try:
            for step in case.body:
                awaited = step(controller, line)
                if inspect.isawaitable(awaited):
                    await awaited
        finally:
            count, began = len(line.received), line.now

    try:
        talk(line, work, **{"settle": 0, "on_exit": "hold", **case.given})
    except (Stopped, NotHeldError) as raised:
        error = raised
    assert line.closed
    assert line.received[count:] == [*case.sent]
    assert line.now - began < 2.2
    return error


@pytest.mark.parametrize("talk", TALKS)
@in_turn("case", lambda: CASES, ids=lambda case: case.about)
def test_what_was_moved_is_held_or_released_last_of_all(
    talk: Talk, case: Case, caplog: pytest.LogCaptureFixture
) -> None:
    error = carried_out(case, talk)
    assert (error is None) == (case.left is None)
    if isinstance(error, NotHeldError) and case.left is not None:
        assert error.left.keys() == case.left.keys()
        assert [why for number, why in case.left.items() if why not in error.left[number]] == []
        assert isinstance(error.__cause__, case.cause or type(None))
    assert not caplog.records


@pytest.mark.parametrize("talk", TALKS)
@in_turn("case", lambda: CASES, ids=lambda case: case.about)
def test_an_exception_that_is_under_way_wins(
    talk: Talk, case: Case, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.clear()
    error = carried_out(case._replace(body=[*case.body, stop]), talk)
    assert isinstance(error, Stopped)
    notes = getattr(error, "__notes__", [])
    shown = [record.getMessage() for record in caplog.records if record.levelname == "WARNING"]
    assert len(shown) == (case.left is not None)
    if sys.version_info >= (3, 11):
        assert [each.partition(": ")[2] for each in shown] == notes


# -------------------------------------------------------------------- Ctrl-C
class Pressed(VirtualLine):
    """A line whose reads are interrupted at these times, as Ctrl-C does it."""

    def __init__(self, *times: float) -> None:
        super().__init__(lambda message: [(0.05, each) for each in where(message)])
        self.times = [*times]

    def read(self, timeout: float) -> bytes:
        if self.times and self.now + timeout >= self.times[0]:
            self.now = self.times.pop(0)
            raise KeyboardInterrupt
        return super().read(timeout)


@in_turn(
    "times, sent", lambda: [((1.0,), held((1, 433))), ((1.0, 1.001), [ServoPositionsRead([1])])]
)
def test_ctrl_c_stops_a_motion_that_is_waited_for_and_a_second_one_just_leaves(
    times: tuple[float, ...], sent: list[Message], caplog: pytest.LogCaptureFixture
) -> None:
    caplog.clear()
    line = Pressed(*times)
    with pytest.raises(KeyboardInterrupt), client_on(line, Controller, on_exit="hold") as arm:
        arm.move_servos([(1, 900)], LONG).wait()
    assert line.received == [ServoMove(LONG, [(1, 900)]), *sent]
    assert line.closed
    assert line.now < 1.2
    said = ["not held: 1" in each.getMessage() for each in caplog.records]
    assert said == [True] * (len(times) - 1)


def test_a_task_that_is_cancelled_holds_and_one_that_is_cancelled_twice_just_leaves(
    caplog: pytest.LogCaptureFixture,
) -> None:
    async def work(line: VirtualLine, cancels: int) -> float:
        async def motion() -> None:
            async with client(line, on_exit="hold", settle=0) as arm:
                await (await arm.move_servos([(1, 900)], LONG)).wait()

        task = asyncio.ensure_future(motion())
        for _ in range(cancels):
            await asyncio.sleep(0.1)
            task.cancel()
        began = line.now
        with pytest.raises(asyncio.CancelledError):
            await task
        while not line.closed:
            await asyncio.sleep(0.01)
        return line.now - began

    line = VirtualLine(where)
    run(work(line, 1), line)
    assert line.received == [ServoMove(LONG, [(1, 900)]), *held((1, 433))]
    assert not caplog.records
    line = VirtualLine(unanswered)
    assert run(work(line, 2), line) < 0.1
    assert line.received == [ServoMove(LONG, [(1, 900)]), ServoPositionsRead([1])]
    [record] = caplog.records
    assert record.getMessage() == "virtual line: servos not held: 1 (no answer)"


class Failing(LiveLine):
    """A line that is lost at the command which holds, once it may be."""

    def __init__(self) -> None:
        super().__init__(where)
        self.go_on = threading.Event()

    def write(self, data: bytes) -> None:
        if data == ServoMove(100, [(1, 433)]).encode():
            assert self.go_on.wait(GENEROUS)
            self.unplug()
        super().write(data)


def test_a_line_that_is_lost_while_it_carries_the_last_command_has_held_nobody(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    shut = LineThreads.shut

    def shut_late(threads: LineThreads, drain: float) -> None:
        lines[0].go_on.set()
        shut(threads, drain)

    async def work() -> None:
        async with AsyncController(lines[0], on_exit="hold", **LIVE) as arm:
            await arm.move_servos([(1, 900)], LONG)

    # The last command is handed over, and the port takes it only as the line is closed.
    monkeypatch.setattr(LineThreads, "shut", shut_late)
    lines = [Failing(), Failing()]
    problem = r"servos not held: 1 \(live line: the line was lost; plug it in again\)"
    with pytest.raises(NotHeldError, match=problem):
        asyncio.run(work())
    lines[1].go_on.set()
    arm = Controller(lines[1], on_exit="hold", **LIVE)
    with pytest.raises(NotHeldError, match=problem), arm:
        arm.move_servos([(1, 900)], LONG)


# -------------------------------------------------------------------- closed by hand
def test_closing_by_hand_holds_as_well_and_lets_an_exception_go_on() -> None:
    def closed(under_way: bool) -> None:
        line = VirtualLine()
        controller = client_on(line, Controller, on_exit="hold", settle=None)
        try:
            controller.move_servos([(1, 900)], LONG)
            if under_way:
                raise Stopped
        finally:
            controller.close()
            assert line.closed

    with pytest.raises(NotHeldError, match=r"servos not held: 1 \(no answer\)"):
        closed(under_way=False)
    with pytest.raises(Stopped):
        closed(under_way=True)


@in_virtual_time
async def test_a_client_for_asyncio_holds_what_it_is_told_to_without_having_done_anything() -> None:
    line = VirtualLine(where)
    await client(line, on_exit="hold", ids=(2,), settle=0).close()
    assert line.received == held((2, 612))


def test_closing_in_another_thread_holds_while_a_motion_is_waited_for() -> None:
    line = LiveLine(where)
    with ThreadPoolExecutor() as pool:
        arm = Controller(line, on_exit="hold", **LIVE)
        motion = arm.move_servos([(1, 900)], 60_000)
        pending = pool.submit(motion.wait)
        pool.submit(arm.close).result(GENEROUS)
        with pytest.raises(ClosedError):
            pending.result(GENEROUS)
    assert line.received[1:] == held((1, 433))
    assert line.closed


class Interrupted(LiveLine):
    """A line that calls `meanwhile` in the middle of a read, as a signal handler is called.

    It can be read by one call at a time, as a port of the system can.
    """

    def __init__(self) -> None:
        super().__init__(where)
        self.meanwhile: list[Callable[[], None]] = []
        self.reading = threading.Lock()

    def read(self, timeout: float) -> bytes:
        assert self.reading.acquire(timeout=GENEROUS), "the read that it waits for is its own"
        try:
            if self.meanwhile:
                self.meanwhile.pop()()
            return super().read(timeout)
        finally:
            self.reading.release()


@in_turn("ask", lambda: [False, True])
@in_turn("leave", lambda: [False, True])
def test_a_signal_handler_may_close_in_the_middle_of_a_call(ask: bool, leave: bool) -> None:
    line = Interrupted()
    arm = Controller(line, background=False, on_exit="hold", **LIVE)
    motion = arm.move_servos([(1, 900)], 60_000)

    def handle() -> None:
        arm.unload_servos([7])
        arm.close()
        if leave:
            raise SystemExit

    line.meanwhile.append(handle)
    with pytest.raises(SystemExit if leave else ClosedError):
        arm.read_battery_voltage() if ask else motion.wait()
    assert line.closed
    assert line.received[-3:] == [ServoUnload([7]), *held((1, 433))]
    arm.close()


def test_a_signal_handler_may_close_while_a_stream_of_commands_is_sent() -> None:
    line = LiveLine(where)
    write = line.write

    def interrupted(data: bytes) -> None:
        line.write = write  # type: ignore[method-assign]
        arm.close()
        write(data)

    arm = Controller(line, background=False, on_exit="hold", **LIVE)
    arm.move_servos([(2, 900)], LONG)
    line.write = interrupted  # type: ignore[method-assign]
    arm.move_servos([(1, 900)], LONG, latest=True)
    assert line.received[1:] == [ServoMove(LONG, [(1, 900)]), *held((2, 612), (1, 433))]
    assert line.closed


# -------------------------------------------------------------------- what it may be
def test_what_is_nothing_to_do_on_exit_is_refused() -> None:
    wrong: Any
    for kind in (Controller, AsyncController):
        for wrong in ("stop", "", True):
            with pytest.raises(ValueError, match=r"on_exit is .*must be 'hold', 'unload' or None$"):
                kind(VirtualLine(), on_exit=wrong)
    for other in (lxservo.Controller, lxservo.AsyncController):
        with pytest.raises(ValueError, match="'hold', and this protocol has no positions to hold"):
            other(VirtualLine(), on_exit="hold")


def test_other_protocols_hold_and_release_in_words_of_their_own() -> None:
    with library(library_of(DEMO.with_name("blinds.yaml"))) as blinds:
        rolled: list[Any] = []

        class Motor(blinds.Device):  # type: ignore[misc, name-defined]
            def on_blinds_read(self, message: Any) -> Any:
                return blinds.BlindsState([(each, 7) for each in message.blind_ids if each != 9])

            def on_blinds_roll(self, message: Any) -> None:
                rolled.append([tuple(each) for each in message.heights])

            def on_blinds_release(self, message: Any) -> None:
                rolled.append(message.blind_ids)

        problem = r"^blinds not held: 9 \(no answer\)$"
        hub = client_of(Motor(), on_exit="hold")
        with pytest.raises(blinds.NotHeldError, match=problem), hub:
            hub.roll([(4, 50), (9, 50)], roll_ms=3000)
        with client_of(Motor(), on_exit="release", ids=(5,)):
            pass
        assert rolled == [[(4, 50), (9, 50)], [(4, 7)], (5,)]
        with pytest.raises(ValueError, match="must be 'hold', 'release' or None"):
            client_of(Motor(), on_exit="unload")


def test_a_port_that_is_opened_for_asyncio_is_left_in_the_same_way() -> None:
    async def work(port: str, error: BaseException | None) -> None:
        async with open_async_controller(port, baud=math.inf, on_exit="hold") as arm:
            await arm.move_servos([(1, 900), (99, 900)], 60_000)
            if error is not None:
                raise error

    with VirtualController("tcp") as board:
        with pytest.raises(NotHeldError, match=r"servos not held: 99 \(no answer\)"):
            asyncio.run(work(board.port, None))
        with pytest.raises(Stopped):
            asyncio.run(work(board.port, Stopped()))
        assert board.servos[1].position < 600
