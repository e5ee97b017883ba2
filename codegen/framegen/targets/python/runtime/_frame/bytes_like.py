"""Bytes at the border: what is accepted as bytes, and how bytes are written for people."""

from __future__ import annotations


def as_bytes(data: bytes | bytearray | memoryview) -> bytes:
    """`data` as plain bytes. Raises TypeError for what is not bytes-like, text above all."""
    if type(data) is bytes:
        return data
    if isinstance(data, (bytes, bytearray, memoryview)):
        # By its buffer: a class derived from bytes may have its own idea of being copied.
        return bytes(memoryview(data))
    hint = "; bytes.fromhex() reads hex" if isinstance(data, str) else ""
    raise TypeError(f"bytes, bytearray or memoryview expected, not {type(data).__name__}{hint}")


def format_hex(data: bytes) -> str:
    """Bytes as people write them: `0A 1B FF`."""
    return data.hex(" ").upper()
