"""Long conversations with a virtual board, in which every wrong value shows.

The board answers each question with a number that no other answer has, so that a reply taken for
another's is seen. Every report that leaves it is recorded, and so is every value that a client
received: none may come twice, and none that was sent before the call began.
"""

import threading
import time
from collections.abc import Callable, Iterator
from random import Random
from typing import Any

import busservo
from busservo import BatteryVoltage, Controller, IncompleteReplyError, Message, ServoPosition
from busservo._library import LIBRARY
from busservo_simulator import Faults, VirtualController
from framewire.simulator.fault_injector import Report

from tests.lines.both_clients import Awaited, done_at_once, moment, until
from tests.timeouts import GENEROUS

ABSENT = ServoPosition.POSITION_ABSENT
# No call may take longer, on however slow a machine.
BOUND = GENEROUS
# No frame comes to the client in pieces: a busy machine would hold up the second one for so long
# that the frame is lost, as on a line that is quiet within a frame. In virtual time, they do.
FAULTS = {
    "mixed": Faults(
        noise=0.3,
        coalesced=0.2,
        delays=0.3,
        dropped=0.05,
        fewer=0.1,
        absent=0.1,
        unsolicited=0.5,
        longest_delay=0.05,
        splits_to_board=0.3,
    ),
    "cut": Faults(noise=0.2, unsolicited=0.3, hang_up=0.08),
}


class Ledger:
    """The questions and reports of a board, and the values that its clients received.

    It numbers the answers of the board, and records the reports that leave it.
    """

    def __init__(self, board: VirtualController) -> None:
        self.board = board
        self.questions = self.right = self.refused = self.reconnected = 0
        self.reported: list[Report] = []
        # By number, so that a long soak needs no more room than a short one.
        self._given = bytearray(1 << 20)
        self._lock = threading.Lock()
        board.board.on_battery_voltage_read = self._voltage  # type: ignore[method-assign, assignment]
        board.board.on_servo_positions_read = self._positions  # type: ignore[method-assign]
        injector = board._line._injector
        reports = injector.reports

        def noted(report: Report) -> Iterator[Report]:
            for sent in reports(report):
                if not isinstance(sent, tuple(LIBRARY.answers)):
                    self.reported.append(sent)
                yield sent

        injector.reports = noted  # type: ignore[method-assign]

    def _next(self) -> int:
        self.questions += 1
        # Of 16 bits, and never the number that stands for a servo that is not there.
        return self.questions % ABSENT

    def _voltage(self, _message: busservo.BatteryVoltageRead) -> BatteryVoltage:
        return BatteryVoltage(self._next())

    def _positions(self, message: busservo.ServoPositionsRead) -> busservo.ServoPositions:
        number = self._next()
        return busservo.ServoPositions([(servo, number) for servo in message.servo_ids])

    def given(self, before: int, values: set[int]) -> None:
        """Record a call that began after answer `before`, and the values it returned."""
        with self._lock:
            assert len(values) <= 1, "of one reply, all values are the same"
            for value in values:
                number = self.questions - (self.questions - value) % ABSENT
                assert before < number <= self.questions, (
                    "a value was given before it was requested"
                )
                assert not self._given[number], "a reply was given to two callers"
                self._given[number] = 1
            self.right += 1

    def given_part(self, before: int, requested: list[int], error: IncompleteReplyError) -> None:
        """Record a call that returned some servos, and which are missing."""
        there = [each for each in error.arrived if isinstance(each, ServoPosition)]
        assert sorted([*(each.servo_id for each in there), *error.missing]) == sorted(requested)
        assert error.missing
        self.given(before, {each.position for each in there} - {ABSENT})

    def given_all(
        self, before: int, requested: list[int], positions: tuple[ServoPosition, ...]
    ) -> None:
        """Record a call that returned all servos."""
        assert sorted(each.servo_id for each in positions) == sorted(requested)
        self.given(before, {each.position for each in positions} - {ABSENT})

    def over(self, controller: Controller | busservo.AsyncController) -> bool:
        """Return whether the board has received everything: it has then sent all its reports."""
        return self.board.accepted == controller.counters.sent


def reports_received(controller: Controller, ledger: Ledger) -> list[Message]:
    """Return the reports, once all have come, and any that should not be there."""
    return done_at_once(reports_received_async(Awaited(controller), ledger))


async def reports_received_async(controller: Any, ledger: Ledger) -> list[Message]:
    """Return the same, for asyncio."""
    await until(controller, lambda: ledger.over(controller))
    received: list[Message] = []
    async for report in controller.reports(timeout=GENEROUS if ledger.reported else 0.1):
        received.append(report)
        if len(received) == len(ledger.reported):
            break
    return received + [report async for report in controller.reports(timeout=0.1)]


def turns(seed: int, count: int) -> Iterator[list[int] | str]:
    """Yield the next call: a list of servos to read, or the name of something else."""
    random = Random(seed)  # noqa: S311 - to be repeated
    for _ in range(count):
        if random.random() < 0.5:
            yield random.choice(["battery", "battery", "move", "unload"])
        else:
            yield random.sample(range(1, 7), random.randint(1, 6))


def converse(controller: Controller, *given: Any, **more: Any) -> None:
    """Make so many calls, with a client for threads."""
    done_at_once(converse_async(Awaited(controller), *given, **more))


async def converse_async(
    controller: Any,
    ledger: Ledger,
    seed: int,
    count: int,
    now: Callable[[], float] = time.monotonic,
    bound: float = BOUND,
) -> None:
    """Make `count` calls. Whatever goes wrong: a right value or a declared error, in time."""
    for turn in turns(seed, count):
        before, began = ledger.questions, now()
        try:
            if turn == "battery":
                ledger.given(before, {await controller.read_battery_voltage()})
            elif turn == "move":
                await controller.move_servos([(1, 500)], time_ms=20)
            elif turn == "unload":
                await controller.unload_servos([200])
            elif isinstance(turn, list):
                ledger.given_all(before, turn, await controller.read_servo_positions(turn))
        except busservo.NoReplyError:
            ledger.refused += 1
        except IncompleteReplyError as error:
            assert isinstance(turn, list)
            ledger.given_part(before, turn, error)
        except busservo.DisconnectedError:
            assert now() - began <= bound
            ledger.board.plug_in()
            await again(controller)
            ledger.reconnected += 1
            continue
        assert now() - began <= bound


async def again(controller: Any) -> None:
    """Reconnect, as often as it takes."""
    end = time.monotonic() + BOUND
    while True:
        try:
            await controller.reconnect()
        except busservo.TransportError:
            assert time.monotonic() < end
            await moment(controller)
        else:
            return
