"""The serial line of a protocol: its rate, the form of a byte, and what it does besides."""

from __future__ import annotations


class Link:
    """How the two ends are connected.

    `baud` is in bits per second, `parity` one of none, even, odd, mark and space. `local_echo` says
    that each end receives what it sends itself. `hid_devices` are those that are reached by USB
    HID: vendor, product and the bytes of a report.
    """

    __slots__ = ("baud", "data_bits", "hid_devices", "local_echo", "parity", "stop_bits")

    def __init__(
        self,
        *,
        baud: int,
        data_bits: int = 8,
        parity: str = "none",
        stop_bits: int = 1,
        local_echo: bool = False,
        hid_devices: tuple[tuple[int, int, int], ...] = (),
    ) -> None:
        self.baud = baud
        self.data_bits = data_bits
        self.parity = parity
        self.stop_bits = stop_bits
        self.local_echo = local_echo
        self.hid_devices = hid_devices

    def report_size(self, vendor: int, product: int) -> int | None:
        """Return the bytes of a report of such a device; None if it is not of this protocol."""
        sizes = {(each, its): size for each, its, size in self.hid_devices}
        return sizes.get((vendor, product))

    @property
    def bits_per_byte(self) -> int:
        """How many bits a byte takes, its start bit included."""
        return 1 + self.data_bits + (self.parity != "none") + self.stop_bits
