"""The end of a line: closed, lost, given up, forgotten; and its return."""

import asyncio
import gc
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, wait
from pathlib import Path
from typing import Any

import busservo
import pytest
from busservo import AsyncController, ClosedError, Controller, DisconnectedError, ServoUnload
from framewire.client.awaited import Awaited as Opening

from tests.in_turn import in_turn
from tests.lines.both_clients import LIVE_TALKS, Talk, both_live
from tests.lines.gates import Gate, whoever_closes_second_waits
from tests.lines.live_line import LiveLine, answered, in_a_loop, losing
from tests.lines.receiving import unanswered
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine
from tests.programs import ran
from tests.timeouts import GENEROUS, LIVE, await_that

REFUSING = losing("it takes no bytes")
STOPPED = busservo.ActionGroupStopped()


def own_threads() -> int:
    return sum(each.name.startswith("busservo on") for each in threading.enumerate())


@pytest.fixture(autouse=True)
def nothing_is_left_behind() -> Iterator[None]:
    """Wait for threads, also those of other tests: closing may not wait long enough for them."""
    await_that(lambda: not own_threads())
    Counted.open = Counted.made = 0
    yield
    await_that(lambda: not own_threads())
    assert Counted.open == 0


def close_in_a_hurry(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in ("client", "thread_client", "async_client", "line_threads"):
        monkeypatch.setattr(f"framewire.client.{module}.DRAIN_TIMEOUT", 0.02)


async def close(controller: AsyncController) -> None:
    await controller.close()


async def cancelled(task: asyncio.Task[Any]) -> None:
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task


# -------------------------------------------------------------------- closed by several
def test_whoever_closes_second_waits_for_whoever_closes_first() -> None:
    draining = Gate()
    line = LiveLine(drain=draining)
    whoever_closes_second_waits(Controller(line), draining, line)


def test_closing_while_closing_does_not_wait_for_itself() -> None:
    """As a handler of signals may, which runs in the middle of anything."""
    line = LiveLine()
    controller = Controller(line)
    line.before["drain"] = controller.close
    controller.close()
    assert line.closed


def test_closing_in_the_middle_of_a_write_does_not_wait_for_itself(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    close_in_a_hurry(monkeypatch)
    line = LiveLine()
    controller = Controller(line)
    line.before["write"] = controller.close

    def send() -> None:
        with pytest.raises(ClosedError):
            controller.stop_action_group()

    # Not in a pool, which would wait for a thread that never ends.
    sending = threading.Thread(target=send, daemon=True)
    sending.start()
    sending.join(GENEROUS)
    assert not sending.is_alive()
    assert line.closed


def test_a_callback_may_close_while_another_thread_does() -> None:
    draining = Gate()
    line = LiveLine(drain=draining)
    notified, closed = threading.Event(), threading.Event()

    def close_too(_report: busservo.Message) -> None:
        notified.set()
        draining.wait()
        controller.close()
        closed.set()

    with ThreadPoolExecutor() as pool:
        controller = Controller(line)
        controller.on_report(close_too)
        line.say(STOPPED)
        assert notified.wait(GENEROUS)
        closing = pool.submit(controller.close)
        assert closed.wait(GENEROUS), "it waits for nobody who may be waiting for it"
        draining.go_on.set()
        closing.result(GENEROUS)


def test_a_controller_that_is_not_open_yet_says_how_to_open_it() -> None:
    opening: Any = busservo.open_async_controller("/dev/nothing")
    for name in ("on_report", "read_battery_voltage", "counters"):
        problem = f"not open yet, and has no '{name}': .*async with"
        with pytest.raises(AttributeError, match=problem):
            getattr(opening, name)
    assert not hasattr(opening, "reports")
    with pytest.raises(TypeError, match=r"not open yet: .*`async with`, or await it$"), opening:
        pass


# -------------------------------------------------------------------- forgotten
def test_a_client_that_is_forgotten_says_so_and_gives_everything_back(tmp_path: Path) -> None:
    line, trace = LiveLine(), tmp_path / "line.log"
    controller = Controller(line, **LIVE, trace=trace)
    assert controller.read_battery_voltage() == 7500
    assert own_threads() == 1
    # The thread that drops the last reference gets the warning, which need not be this one.
    warned: list[str] = []

    def forget(controller: Controller) -> None:
        def warn(text: str, kind: type[Warning], source: object) -> None:
            assert (kind, source) == (ResourceWarning, controller)
            warned.append(text)

        Controller.__del__(controller, warn)

    controller.__class__ = type("Watched", (Controller,), {"__del__": forget})
    del controller
    await_that(lambda: line.closed and not own_threads())
    assert warned == ["live line was never closed: use the client in a `with`, or call close()"]
    assert trace.read_text().count("\n") == 3


class Forgotten(AsyncController):
    """A client whose warning is kept."""

    warned: list[str] | None = None

    def __del__(self) -> None:  # type: ignore[override]
        super().__del__(lambda text, *_, **__: (self.warned or []).append(text))


def test_a_client_for_asyncio_that_is_forgotten_says_so_and_gives_everything_back() -> None:
    line = LiveLine()
    warned = ["before it"]

    async def work() -> None:
        controller = Forgotten(line, **LIVE)
        controller.warned = warned
        assert await controller.read_battery_voltage() == 7500
        assert own_threads() == 2

    asyncio.run(work())
    gc.collect()
    await_that(lambda: line.closed and not own_threads())
    assert len(warned) == 2


def test_a_script_that_leaves_a_client_open_ends() -> None:
    program = f"""if True:
        import sys
        sys.path[:] = {sys.path!r}
        import asyncio
        from busservo import AsyncController
        from tests.lines.live_line import LiveLine

        async def work():
            controller = AsyncController(LiveLine())
            await controller.stop_action_group()
            return controller

        controller = asyncio.run(work())
    """
    ran(sys.executable, "-c", program)


class ReadsOn(LiveLine):
    """A line whose reads find nothing once it is closed, rather than say so."""

    def read(self, timeout: float) -> bytes:
        try:
            return super().read(timeout)
        except ClosedError:
            time.sleep(min(timeout, 0.001))
            return b""


class Touchy(LiveLine):
    """A line whose reads fail once it is closed, in words of their own."""

    def read(self, timeout: float) -> bytes:
        try:
            return super().read(timeout)
        except ClosedError:
            raise ValueError("file descriptor cannot be a negative integer (-1)") from None


@pytest.mark.parametrize("talk", LIVE_TALKS)
@in_turn("line", lambda: [LiveLine, ReadsOn, Touchy])
def test_no_thread_reads_on_where_a_client_is_closed(
    talk: Talk, line: type[LiveLine], caplog: pytest.LogCaptureFixture
) -> None:
    kept: list[Any] = []

    async def work(controller: Any) -> None:
        assert await controller.read_battery_voltage() == 7500
        kept.append(controller)

    for _ in range(3):
        talk(line(), work, **LIVE)
        await_that(lambda: not own_threads())
    assert [each.closed for each in kept] == [True] * 3
    # What a transport says of being closed is no bug.
    assert caplog.records == []


def test_the_warning_is_a_resource_warning() -> None:
    controller = Controller(VirtualLine(), background=False)
    with pytest.warns(ResourceWarning, match=r"virtual line was never closed: use .* a `with`"):
        controller.__del__()
    controller = Controller(VirtualLine(), background=False)
    controller.close()
    controller.__del__()  # and says nothing


# -------------------------------------------------------------------- a line that fails
@pytest.mark.parametrize("talk", LIVE_TALKS)
@in_turn("call", lambda: ["stop_action_group", "read_battery_voltage"])
def test_what_the_port_does_not_take_fails_at_once(talk: Talk, call: str) -> None:
    async def work(controller: Any) -> None:
        began = time.monotonic()
        with pytest.raises(DisconnectedError, match="takes no bytes"):
            await getattr(controller, call)()
        assert time.monotonic() - began < GENEROUS / 2

    talk(LiveLine(write=REFUSING), work, **LIVE)


@in_a_loop
async def test_a_command_counts_as_sent_only_when_the_port_has_taken_it() -> None:
    line = LiveLine(write=lambda: time.sleep(0.05))
    async with AsyncController(line) as controller:
        await controller.stop_action_group()
        assert line.received


def broken() -> None:
    raise KeyError(0.5)


@both_live(lambda: LiveLine(read=broken), **LIVE)
async def test_a_transport_with_a_bug_ends_in_an_error_that_says_so(controller: Any) -> None:
    for _ in range(3):
        with pytest.raises(
            busservo.TransportError, match=r"failed .*KeyError.*; mend the transport"
        ):
            await controller.read_battery_voltage()


# -------------------------------------------------------------------- closed
def press_ctrl_c() -> None:
    raise KeyboardInterrupt


def test_close_gives_the_port_back_even_when_it_is_interrupted() -> None:
    line = VirtualLine(read=press_ctrl_c)
    controller = client_on(line, Controller, settle=None)
    controller.unload_servos(range(200))
    with pytest.raises(KeyboardInterrupt):
        controller.close()
    assert line.closed
    with pytest.raises(ClosedError):
        controller.stop_action_group()


def test_close_that_is_cancelled_is_done_all_the_same() -> None:
    line = LiveLine()

    async def work() -> None:
        # The frame is on its way for longer than any machine pauses.
        controller = AsyncController(line, baud=60)
        await controller.unload_servos(range(240))
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(controller.close(), 0.02)

    # The loop ends while the frame is still on its way.
    asyncio.run(work())
    assert line.closed


def late(message: busservo.Message) -> list[tuple[float, bytes | busservo.Message]]:
    return [(0.1, each) for each in answered(message)]


def test_a_call_that_is_interrupted_leaves_the_line_usable() -> None:
    line = VirtualLine(late, read=press_ctrl_c)
    with client_on(line, Controller) as controller:
        with pytest.raises(KeyboardInterrupt):
            controller.read_battery_voltage()
        line.before.clear()
        assert controller.read_servo_positions([1]) == ((1, 10),)
        assert controller.read_battery_voltage() == 7500
        # The reply to the first came late, and was not taken for another's.
        assert controller.counters.unsolicited == 1


class Interrupting:
    """The lock of a client; Ctrl-C comes as soon as it has been released to read."""

    def __init__(self, lock: Any) -> None:
        self._lock = lock
        self.acquire = lock.acquire

    def __enter__(self) -> object:
        return self._lock.__enter__()

    def __exit__(self, *error: object) -> None:
        self._lock.__exit__(*error)

    def release(self) -> None:
        self._lock.release()
        raise KeyboardInterrupt


def test_ctrl_c_as_the_line_is_given_to_others_leaves_it_usable() -> None:
    with client_on(VirtualLine(late), Controller) as controller:
        whole = controller._lock
        controller._lock = Interrupting(whole)
        with pytest.raises(KeyboardInterrupt):
            controller.read_battery_voltage()
        controller._lock = whole
        with ThreadPoolExecutor() as pool:
            # Also from another thread, which it would keep waiting.
            assert pool.submit(controller.read_battery_voltage).result(GENEROUS) == 7500


def test_pending_frames_are_sent_although_the_machine_pauses_while_closing() -> None:
    line = VirtualLine()
    # Each look at the clock may be the one before which the machine pauses.
    pauses = iter([0.0, 60.0])

    def clock() -> float:
        line.now += next(pauses, 0.0) if closing else 0.0
        return line.clock()

    closing = False
    controller = Controller(line, background=False, clock=clock)
    controller.unload_servos(range(200))
    controller.send_latest(ServoUnload([7]))
    assert len(line.received) == 1
    closing = True
    controller.close()
    assert line.received[-1] == ServoUnload([7])


# -------------------------------------------------------------------- opened again
def absent() -> None:
    raise busservo.PortNotFoundError(LiveLine.name, "there is no such port", "plug it in")


@both_live(lambda: LiveLine(reopen=absent), **LIVE)
async def test_a_line_that_does_not_come_back_says_why_until_it_does(
    controller: Any, line: LiveLine
) -> None:
    line.unplug()
    for _ in range(2):
        for call in (controller.reconnect, controller.read_battery_voltage):
            with pytest.raises(busservo.PortNotFoundError, match="plug it in"):
                await call()
    line.before.clear()
    await controller.reconnect()
    assert await controller.read_battery_voltage() == 7500


class Counted(LiveLine):
    """A line that counts how many are and were open, and is opened again through a gate."""

    open = made = 0

    def __init__(self, opening: Callable[[], object] = int) -> None:
        super().__init__(reopen=opening)
        Counted.open += 1
        Counted.made += 1

    def close(self) -> None:
        if not self.closed:
            Counted.open -= 1
        super().close()

    def reopen(self) -> LiveLine:
        assert Counted.open == 0, "the port was opened twice"
        self._begin("reopen")
        return Counted()


def test_threads_that_reconnect_at_once_open_the_port_once() -> None:
    line = Counted(lambda: time.sleep(0.05))
    with Controller(line, **LIVE) as controller, ThreadPoolExecutor(8) as pool:
        line.unplug()
        list(pool.map(lambda _: controller.reconnect(), range(8)))
        assert controller.read_battery_voltage() == 7500
        assert Counted.open == 1
        await_that(lambda: own_threads() == 1)


@in_a_loop
async def test_tasks_that_reconnect_at_once_open_the_port_once() -> None:
    line = Counted(lambda: time.sleep(0.05))
    async with AsyncController(line, **LIVE) as controller:
        line.unplug()
        await asyncio.gather(*(controller.reconnect() for _ in range(20)))
        assert await controller.read_battery_voltage() == 7500
        assert Counted.open == 1
        await_that(lambda: own_threads() == 2)


# By then; but closing waits only for a while for a port that does not open.
@pytest.mark.parametrize("patient", [True, False])
def test_what_is_closed_while_it_is_opened_again_is_given_back(
    patient: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not patient:
        close_in_a_hurry(monkeypatch)
    opening = Gate()
    controller = Controller(Counted(opening))
    with ThreadPoolExecutor(2) as pool:
        again = pool.submit(controller.reconnect)
        opening.wait()
        closing = pool.submit(controller.close)
        done, _ = wait([closing], timeout=0.05 if patient else GENEROUS)
        assert not again.done()
        opening.go_on.set()
        assert bool(done) is not patient, "the port may be open"
        closing.result(GENEROUS)
        assert not patient or Counted.open == 0
        with pytest.raises(ClosedError):
            again.result(GENEROUS)


@pytest.mark.parametrize("patient", [True, False])
@in_a_loop
async def test_what_is_closed_while_it_is_opened_again_is_given_back_with_asyncio(
    patient: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not patient:
        close_in_a_hurry(monkeypatch)
    opening = Gate()
    controller = AsyncController(Counted(opening))
    await controller.stop_action_group()
    again = asyncio.ensure_future(controller.reconnect())
    await opening.reached()
    closing = asyncio.ensure_future(controller.close())
    done, _ = await asyncio.wait([closing], timeout=0.05 if patient else GENEROUS)
    assert not again.done()
    opening.go_on.set()
    assert bool(done) is not patient, "the port may be open"
    await closing
    assert not patient or Counted.open == 0
    for reconnecting in (again, controller.reconnect()):
        with pytest.raises(ClosedError):
            await reconnecting


@in_a_loop
async def test_opening_again_that_is_cancelled_leaves_no_port_open() -> None:
    opening = Gate()
    async with AsyncController(Counted(opening), **LIVE) as controller:
        again = asyncio.ensure_future(controller.reconnect())
        await opening.reached()
        await cancelled(again)
        opening.go_on.set()
        while Counted.made < 2 or Counted.open:
            await asyncio.sleep(0.001)
        await controller.reconnect()
        assert await controller.read_battery_voltage() == 7500


def test_reconnecting_from_within_a_callback() -> None:
    line = LiveLine()
    done = threading.Event()
    with Controller(line, **LIVE) as controller:

        def again(_: object) -> None:
            controller.reconnect()
            done.set()

        controller.on_report(again)
        line.say(STOPPED)
        assert done.wait(GENEROUS)
        assert controller.read_battery_voltage() == 7500
        await_that(lambda: own_threads() == 1)


@in_a_loop
async def test_a_cancelled_reconnect_that_fails_raises_nowhere() -> None:
    opening = Gate()

    def reopen() -> None:
        opening()
        absent()

    errors: list[object] = []
    asyncio.get_running_loop().set_exception_handler(lambda _, about: errors.append(about))
    async with AsyncController(LiveLine(reopen=reopen)) as controller:
        again = asyncio.ensure_future(controller.reconnect())
        await opening.reached()
        await cancelled(again)
        opening.go_on.set()
        await asyncio.sleep(0.01)
    assert errors == []


@pytest.mark.parametrize("talk", LIVE_TALKS)
def test_the_end_of_a_read_of_the_line_before_does_not_end_the_new_one(
    talk: Talk, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its reads end not when it is closed, but when the test allows it, by an error."""
    close_in_a_hurry(monkeypatch)
    stuck = Gate()

    def read() -> None:
        stuck()
        losing()()

    async def work(controller: Any) -> None:
        before = own_threads()
        await controller.reconnect()
        stuck.go_on.set()
        await_that(lambda: own_threads() == before)
        assert await controller.read_battery_voltage() == 7500

    talk(LiveLine(read=read), work, **LIVE)


# -------------------------------------------------------------------- a driver that gives trouble
def fail() -> None:
    raise OSError("it is gone")


@both_live(lambda: LiveLine(drain=fail, close=fail))
async def test_what_cannot_be_drained_is_closed_all_the_same(
    controller: Any, line: LiveLine, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level("DEBUG", "busservo")
    await controller.stop_action_group()
    await controller.close()
    assert line.closed
    assert len(line.received) == 1
    assert caplog.text.count("live line could not be drained") == 1
    assert caplog.text.count("live line could not be closed") == 1


@in_a_loop
async def test_what_is_still_to_be_sent_when_the_line_is_lost_does_not_hold_up_closing() -> None:
    line = LiveLine()
    # On the wire, both take more than twice as long as anybody waits here.
    controller = AsyncController(line, baud=40)
    controller.send_latest(ServoUnload(range(250)))
    controller.send_latest(ServoUnload(range(240)))
    await_that(lambda: len(line.received) == 1)
    closing = asyncio.ensure_future(controller.close())
    await asyncio.sleep(0)
    line.unplug()
    await asyncio.wait_for(closing, GENEROUS)
    assert repr(controller) == "<AsyncController on live line, closed>"
    assert line.received == [ServoUnload(range(250))]


@in_a_loop
async def test_a_command_whose_turn_comes_as_the_line_is_lost_is_not_reported_as_sent() -> None:
    line = LiveLine()
    now = time.monotonic()
    async with AsyncController(line, clock=lambda: now) as controller:
        assert repr(controller) == "<AsyncController on live line, open>"
        await controller.unload_servos(range(100))
        pending = asyncio.ensure_future(controller.stop_action_group())
        await asyncio.sleep(0)
        # The loop stands still until it is the turn of the second command. When it goes on, the
        # line is lost, as it learns only after that command has been handed over.
        time.sleep(0.12)
        now += 0.12
        await asyncio.sleep(0)
        line.unplug()
        await_that(lambda: own_threads() == 1)
        with pytest.raises(DisconnectedError):
            await pending
        assert repr(controller) == "<AsyncController on live line, failed>"
        assert controller.counters.sent == 2
    assert line.received == [ServoUnload(range(100))]


@in_a_loop
async def test_what_arrives_after_a_line_was_given_up_is_not_reported() -> None:
    line = LiveLine(write=REFUSING)
    async with AsyncController(line) as controller:
        received: list[object] = []
        controller.on_report(received.append)
        controller.send_latest(ServoUnload([1]))
        # The loop stands still: first it will learn that the write has failed, then of this.
        await_that(lambda: own_threads() == 1)
        line.say(STOPPED)
        before = line.reads
        await_that(lambda: line.reads >= before + 2)
        with pytest.raises(DisconnectedError, match="takes no bytes"):
            await controller.wait_for(busservo.ActionGroupStopped, timeout=GENEROUS)
        await asyncio.sleep(0)
        assert received == []
        assert controller.counters.reports == 0


# -------------------------------------------------------------------- a loop that is no more
def test_a_line_goes_quiet_when_its_loop_has_ended() -> None:
    line = LiveLine()

    async def work() -> Forgotten:
        controller = Forgotten(line)
        await controller.stop_action_group()
        return controller

    controller = asyncio.run(work())
    assert own_threads() == 2
    line.say(STOPPED)
    await_that(lambda: own_threads() == 1)
    assert controller.counters.reports == 0
    del controller
    gc.collect()
    await_that(lambda: not own_threads())
    assert line.closed


def test_a_client_that_is_forgotten_while_the_port_takes_its_question() -> None:
    writing = Gate()
    line = LiveLine(write=writing)

    async def work() -> None:
        controller = Forgotten(line, **LIVE)
        asking = asyncio.ensure_future(controller.read_battery_voltage())
        await writing.reached()
        await cancelled(asking)
        del asking, controller
        gc.collect()

    asyncio.run(work())
    gc.collect()
    await_that(lambda: line.closed)
    writing.go_on.set()
    # Nobody is left to notify that the question is written, and the thread that wrote it ends.
    await_that(lambda: not own_threads())


def test_what_a_loop_that_has_ended_left_unsent_is_sent_by_closing_in_another() -> None:
    line = LiveLine()
    commands = [ServoUnload(range(size)) for size in (3, 2, 1)]

    async def use() -> AsyncController:
        controller = AsyncController(line)
        for each in commands:
            controller.send_latest(each)
        return controller

    controller = asyncio.run(use())
    for _ in range(2):
        asyncio.run(close(controller))
        assert line.closed
    assert line.received == commands


def test_a_loop_that_has_ended_with_a_question_under_way_hinders_no_closing() -> None:
    line = LiveLine(unanswered)
    loop = asyncio.new_event_loop()
    # That a task of it is never resumed is what is tried here.
    loop.set_exception_handler(lambda *_: None)

    async def ask() -> tuple[AsyncController, asyncio.Task[int]]:
        controller = AsyncController(line, **LIVE)
        asking = asyncio.ensure_future(controller.read_battery_voltage())
        while not line.received:
            await asyncio.sleep(0.001)
        return controller, asking

    controller, asking = loop.run_until_complete(ask())
    loop.close()
    asyncio.run(close(controller))
    assert line.closed
    assert not asking.done()


def test_what_was_closed_by_a_loop_that_ended_meanwhile_may_be_closed_again() -> None:
    draining = Gate()
    line = LiveLine(drain=draining)

    async def begin() -> AsyncController:
        controller = AsyncController(line)
        await controller.stop_action_group()
        asyncio.ensure_future(controller.close())  # noqa: RUF006 - the client keeps it
        await draining.reached()
        asyncio.get_running_loop().call_soon(draining.go_on.set)
        return controller

    controller = asyncio.run(begin())
    assert line.closed
    asyncio.run(close(controller))


# -------------------------------------------------------------------- a port that opens too late
@in_a_loop
async def test_opening_that_is_cancelled_leaves_no_port_open() -> None:
    line, gate = LiveLine(), Gate()

    def open_late() -> Any:
        gate()
        return line

    async def open_it() -> None:
        await Opening(open_late, AsyncController)

    opening = asyncio.ensure_future(open_it())
    await gate.reached()
    await cancelled(opening)
    gate.go_on.set()
    while not line.closed:
        await asyncio.sleep(0.001)
