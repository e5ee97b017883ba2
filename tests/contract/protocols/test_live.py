"""The programs of others on one end of a line, and a generated device or client on the other."""

import asyncio
import importlib
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
import serial

from tests.protocols.libraries import Libraries
from tests.protocols.peer import MISSING
from tests.timeouts import GENEROUS, LIVE

if sys.platform == "win32":
    pytest.skip("Windows has no pty", allow_module_level=True)

from tests.lines.peer_line import crossed, served


def needed(name: str) -> Any:
    """Import a peer; without it, the test is skipped."""
    return pytest.importorskip(name, reason=MISSING.format(name))


def _device_end(made: Any) -> Any:
    """Return the class of the device end, which is imported by those who want it."""
    return importlib.import_module(f"{made.__name__}.device").Device


def actuators(made: Any, *numbers: int) -> Any:
    """Return the device end of some actuators, each with a table of bytes."""
    tables = {number: bytearray(range(64)) for number in numbers}
    device = _device_end(made)(*numbers)

    def status(message: Any, *data: int, error: int = 0) -> Any:
        return made.Status(message.servo_id, error, list(data))

    def read(message: Any) -> Any:
        table = tables[message.servo_id]
        if message.start + message.size > len(table):
            return status(message, error=made.Status.ERROR_RANGE)
        return status(message, *table[message.start : message.start + message.size])

    def write(message: Any) -> Any:
        to_all = message.servo_id == 254
        for number in numbers if to_all else [message.servo_id]:
            tables[number][message.start : message.start + len(message.data)] = bytes(message.data)
        return None if to_all else status(message)

    device.on_ping = status
    device.on_read = read
    device.on_write = write
    device.tables = tables
    return device


def test_the_makers_library_talks_to_a_generated_actuator(libraries: Libraries) -> None:
    sdk = needed("dynamixel_sdk")
    device = actuators(libraries["dynamixel1"], 1, 2)
    with served(device) as port:
        line, packets = sdk.PortHandler(port), sdk.PacketHandler(1.0)
        # It waits for as long as a wire takes, and not for a machine that is busy.
        line.setPacketTimeout = lambda _length: line.setPacketTimeoutMillis(1000 * GENEROUS)
        assert line.openPort()
        try:
            assert packets.ping(line, 1) == (0x0100, sdk.COMM_SUCCESS, 0)
            assert packets.write2ByteTxRx(line, 2, 30, 500) == (sdk.COMM_SUCCESS, 0)
            assert packets.read2ByteTxRx(line, 2, 30) == (500, sdk.COMM_SUCCESS, 0)
            assert packets.writeTxOnly(line, 254, 25, 1, [7]) == sdk.COMM_SUCCESS
            assert packets.read1ByteTxRx(line, 1, 25) == (7, sdk.COMM_SUCCESS, 0)
            _, result, error = packets.readTxRx(line, 1, 60, 10)
            assert (result, error) == (sdk.COMM_SUCCESS, 8)
        finally:
            line.closePort()
    assert device.rejects.total == 0


def memory(made: Any, unit: int, registers: list[int]) -> Any:
    """Return the device end of a device with holding registers."""
    device = _device_end(made)(unit)

    def read(message: Any) -> Any:
        end = message.start + message.quantity
        if end > len(registers):
            return made.HoldingReadRefused(unit, made.HoldingReadRefused.REASON_ILLEGAL_ADDRESS)
        return made.Holding(unit, registers[message.start : end])

    def write_one(message: Any) -> Any:
        registers[message.start] = message.value
        return made.RegisterWritten(unit, message.start, message.value)

    def write(message: Any) -> Any:
        registers[message.start : message.start + len(message.registers)] = message.registers
        return made.RegistersWritten(unit, message.start, len(message.registers))

    device.on_holding_read = read
    device.on_register_write = write_one
    device.on_registers_write = write
    return device


def test_a_client_of_others_talks_to_a_generated_device(libraries: Libraries) -> None:
    made = libraries["modbus"]
    device = memory(made, 17, list(range(0xAE00, 0xAE80)))
    theirs = needed("pymodbus.client").ModbusSerialClient
    with served(device) as port:
        client = theirs(port, timeout=GENEROUS, retries=0)
        assert client.connect()
        try:
            read = client.read_holding_registers(107, count=3, device_id=17)
            assert read.registers == [0xAE6B, 0xAE6C, 0xAE6D]
            assert client.write_register(1, 3, device_id=17).registers == [3]
            assert client.write_registers(2, [10, 0x0102], device_id=17).count == 2
            assert client.read_holding_registers(1, count=3, device_id=17).registers == [3, 10, 258]
            refused = client.read_holding_registers(200, count=1, device_id=17)
            assert (refused.isError(), refused.exception_code) == (True, 2)
        finally:
            client.close()
    assert device.rejects.total == 0


@contextmanager
def _their_device(port: str) -> Iterator[None]:
    """Serve registers by `pymodbus`, in a thread of its own."""
    server, simulator = needed("pymodbus.server"), needed("pymodbus.simulator")
    block = simulator.SimData(0, values=[10, 20, 30, 0xAE41], datatype=simulator.DataType.REGISTERS)
    device = simulator.SimDevice(17, [block])
    running: list[tuple[asyncio.AbstractEventLoop, Any]] = []
    started = threading.Event()

    async def serve() -> None:
        served = server.ModbusSerialServer(device, port=port)
        await served.serve_forever(background=True)
        running.append((asyncio.get_running_loop(), served))
        started.set()
        await served.serving

    thread = threading.Thread(target=lambda: asyncio.run(serve()), name="their device")
    thread.start()
    assert started.wait(GENEROUS)
    try:
        yield
    finally:
        loop, served = running[0]
        asyncio.run_coroutine_threadsafe(served.shutdown(), loop).result(GENEROUS)
        thread.join(GENEROUS)


def test_a_generated_client_talks_to_a_device_of_others(libraries: Libraries) -> None:
    made = libraries["modbus"]
    with (
        crossed() as (theirs, ours),
        _their_device(theirs),
        made.open_controller(ours, **LIVE) as client,
    ):
        assert list(client.read_holding(17, 1, 3)) == [20, 30, 0xAE41]
        client.write_register(17, 1, 7)
        client.device(17).write_registers(2, [8, 9])
        assert list(client.read_holding(17, 0, 4)) == [10, 7, 8, 9]
        with pytest.raises(made.RefusedError, match="reason=2"):
            client.read_holding(17, 100, 3)


def servos(made: Any, *numbers: int) -> Any:
    """Return the device end of some servos, which are at once where they are told to be."""
    device = _device_end(made)(*numbers)
    positions = dict.fromkeys(numbers, 500)

    def move(message: Any) -> None:
        positions.update(dict.fromkeys(_meant(message), message.position))

    def _meant(message: Any) -> list[int]:
        return list(numbers) if message.servo_id == 254 else [message.servo_id]

    device.on_move = move
    device.on_position_read = lambda message: made.Position(
        message.servo_id, positions[message.servo_id]
    )
    device.on_temperature_read = lambda message: made.Temperature(message.servo_id, 31)
    device.on_led_read = lambda message: made.Led(message.servo_id, 1)
    device.on_offset_read = lambda message: made.Offset(message.servo_id, -10)
    return device


def test_clients_of_others_talk_to_generated_servos(libraries: Libraries) -> None:
    device = servos(libraries["lxservo"], 1, 2)
    with served(device) as port, serial.Serial(port, timeout=GENEROUS) as line:
        theirs = needed("lewansoul_lx16a").ServoController(line, timeout=GENEROUS)
        theirs.move(1, 800, 1000)
        assert [theirs.get_position(number) for number in (1, 2)] == [800, 500]
        assert (theirs.get_temperature(2), theirs.is_led_on(2)) == (31, False)
        assert theirs.get_position_offset(1) == -10

        others = needed("lewanlib.bus").ServoBus(
            serial_conn=line, discard_echo=False, retry_count=0, on_exit_power_off=False
        )
        others.move_time_write(2, 60.1, 1)
        assert others.pos_read(2) == 60
        assert others.temp_read(1, "C") == 31
    assert device.rejects.total == 0
