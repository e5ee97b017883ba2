"""Kaitai Struct: classes that its compiler generates from `servo_frames.ksy`.

The compiler is no Python package.
A `kaitai-struct-compiler` on the path is used when there is one,
else its JavaScript build when `npm install` was run in this folder and there is a `node`.
What it generates goes to a temporary folder and is compiled anew in every run.
"""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import tempfile
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kaitaistruct import KaitaiStream

from benchmarks import floor
from benchmarks.peers import UnavailableError
from benchmarks.peers.interface import Peer

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

FOLDER = Path(__file__).parent
"""Where descriptions and compiler are."""

_SOURCE = FOLDER / "servo_frames.ksy"


def compile_command(folder: str, source: Path, *options: str) -> list[str]:
    """Return the command that compiles a .ksy file into a folder."""
    native = shutil.which("kaitai-struct-compiler")
    if native is not None:
        return [native, "--target", "python", "--outdir", folder, *options, str(source)]
    node = shutil.which("node")
    if node is None or not (FOLDER / "node_modules").is_dir():
        raise UnavailableError("its runtime is there, its compiler is not")
    return [node, str(FOLDER / "compile.js"), str(source), folder, *options]


def compiled(folder: str, source: Path, *options: str) -> Any:
    """Return the class that is generated from a .ksy file, and holds all others."""
    command = compile_command(folder, source, *options)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        reason = done.stderr.strip() or f"exit status {done.returncode}"
        raise UnavailableError(f"kaitai-struct-compiler failed: {reason}")
    path = Path(folder) / f"{source.stem}.py"
    spec = importlib.util.spec_from_file_location(source.stem, path)
    if spec is None or spec.loader is None:
        raise UnavailableError(f"kaitai-struct-compiler wrote no {path.name}")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return getattr(module, "".join(map(str.capitalize, source.stem.split("_"))))


def _parser(kind: Any) -> Callable[[bytes], Any]:
    return lambda frame: kind(KaitaiStream(BytesIO(frame)))


class Kaitai(Peer):
    """Reading by read-only classes, which are faster; writing by read-write classes."""

    name = "Kaitai Struct"
    distribution = "kaitaistruct"
    import_statement = f"import {_SOURCE.stem}"

    def __init__(self) -> None:
        super().__init__()
        self._folders = tempfile.TemporaryDirectory()
        readers = Path(self._folders.name) / "readers"
        writers = Path(self._folders.name) / "writers"
        readers.mkdir()
        writers.mkdir()
        frames = compiled(str(readers), _SOURCE)
        self.import_path = str(readers)
        self.generate_command = compile_command(str(readers), _SOURCE)
        self.parsers: Mapping[int, Callable[[bytes], Any]] = {
            floor.ACTION_GROUP_STARTED: _parser(frames.ActionGroupRun),
            floor.ACTION_GROUP_STOPPED: _parser(frames.ActionGroupStop),
            floor.ACTION_GROUP_COMPLETED: _parser(frames.ActionGroupCompleted),
            floor.BATTERY: _parser(frames.BatteryVoltage),
            floor.POSITIONS: _parser(frames.ServoPositions),
        }
        try:
            self._writers = compiled(str(writers), _SOURCE, "--read-write")
        except UnavailableError:
            self.lacks = {"encode": "this build of its compiler makes readers only"}

    def encode_move(self, time_ms: int, targets: Sequence[tuple[int, int]]) -> bytes:
        """Encode by `_check` and `_write` of an object; nothing is derived, constants included."""
        count = len(targets)
        move = self._writers.ServoMove()
        move.header = b"\x55\x55"
        move.length = 3 * count + 5
        move.command = b"\x03"
        move.count = count
        move.time_ms = time_ms
        move.targets = []
        for servo_id, position in targets:
            servo = self._writers.Servo(None, move, move._root)
            servo.servo_id = servo_id
            servo.position = position
            servo._check()
            move.targets.append(servo)
        move._check()
        # It writes into a stream of a size that is known before.
        buffer = bytearray(3 * count + 7)
        stream = KaitaiStream(BytesIO(buffer))
        move._write(stream)
        frame: bytes = stream.to_byte_array()
        return frame

    def plain(self, command: int, message: Any) -> object:
        """Return an object's values, read by attribute."""
        if command == floor.POSITIONS:
            return tuple((servo.servo_id, servo.position) for servo in message.positions)
        if command == floor.BATTERY:
            return message.voltage_mv
        if command == floor.ACTION_GROUP_STOPPED:
            return None
        return message.group, message.times


def peers() -> list[Peer]:
    """Return the peers of Kaitai Struct."""
    return [Kaitai()]
