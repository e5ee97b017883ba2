"""A second opinion: a serial line bit by bit, and what a receiver makes of the levels on it."""

from collections.abc import Iterator

from framegen.language.spec import Link

# The clocks of both ends are off by so much, one this way and one that.
DRIFT = 0.0125


def understood(sender: Link, receiver: Link, data: bytes) -> bool:
    """Tell whether bytes arrive as they were sent, back to back, with the worst of clocks."""
    return all(
        _received(sender, receiver, data, 1 + sign * DRIFT, 1 - sign * DRIFT) == data
        for sign in (-1, 1)
    )


def _received(
    sender: Link, receiver: Link, data: bytes, faster: float, slower: float
) -> bytes | None:
    """Return the bytes that are read; None where a character is framed wrongly."""
    levels = [bit for byte in data for bit in _bits(sender, byte)]
    bit_time = 1 / (sender.baud * faster)
    step = 1 / (receiver.baud * slower)

    def level(at: float) -> int:
        index = int(at / bit_time)
        return levels[index] if index < len(levels) else 1

    found, at, end = bytearray(), 0.0, len(levels) * bit_time
    while at < end:
        if level(at):
            # Idle: look for the next start bit as finely as receivers do.
            at += step / 16
            continue
        width = receiver.data_bits
        bits = [level(at + step * (each + 1.5)) for each in range(width)]
        last = 1.5 + width
        if receiver.parity != "none":
            if level(at + step * last) != _parity(receiver.parity, sum(bits)):
                return None
            last += 1
        stops = [level(at + step * (last + each)) for each in range(receiver.stop_bits)]
        if not all(stops):
            return None
        found.append(sum(bit << place for place, bit in enumerate(bits)))
        at += step * (last + receiver.stop_bits - 1)
    return bytes(found)


def _bits(link: Link, byte: int) -> Iterator[int]:
    yield 0
    bits = [byte >> place & 1 for place in range(link.data_bits)]
    yield from bits
    if link.parity != "none":
        yield _parity(link.parity, sum(bits))
    yield from [1] * link.stop_bits


def _parity(kind: str, ones: int) -> int:
    return ones % 2 if kind == "even" else 1 - ones % 2
