"""Bytes at the border: what is accepted as bytes, and how bytes are written for people."""

from __future__ import annotations


def octets(data: bytes | bytearray | memoryview) -> bytes:
    """`data` as bytes. Raises TypeError for anything that is not bytes-like, text above all."""
    if isinstance(data, bytes):
        return data
    if isinstance(data, (bytearray, memoryview)):
        return bytes(data)
    hint = "; bytes.fromhex() reads hex" if isinstance(data, str) else ""
    raise TypeError(f"bytes, bytearray or memoryview expected, not {type(data).__name__}{hint}")


def spaced(data: bytes) -> str:
    """Bytes as people write them: `55 55 02 07`."""
    return data.hex(" ").upper()
