"""Conversions of bytes: what is accepted as bytes, and how bytes are printed."""

from __future__ import annotations


def as_bytes(data: bytes | bytearray | memoryview) -> bytes:
    """Return `data` as plain bytes. Raises TypeError if it is not bytes-like, such as text."""
    if type(data) is bytes:
        return data
    if isinstance(data, (bytes, bytearray, memoryview)):
        # By its buffer: a class derived from bytes may redefine how it is copied.
        return bytes(memoryview(data))
    hint = "; bytes.fromhex() reads hex" if isinstance(data, str) else ""
    raise TypeError(f"bytes, bytearray or memoryview expected, not {type(data).__name__}{hint}")


def format_hex(data: bytes) -> str:
    """Return bytes as hex for people: `0A 1B FF`."""
    return data.hex(" ").upper()
