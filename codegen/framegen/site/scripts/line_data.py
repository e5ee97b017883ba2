"""What a page needs to talk over a line: its settings, and what answers what."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model

# The files of the script that talks over a line, in order.
LINE_SCRIPT = (
    "serial_line",
    "serial_echo",
    "serial_replies",
    "serial_recording",
    "serial_session",
    "serial_words",
    "serial_settings",
    "serial_file",
    "serial_log",
    "serial_panel",
)


def line_data(model: Model) -> dict[str, Any]:
    """Return the link, the directions of the client, and its exchanges by the name of the request.

    `received` is None where nothing is ever sent to the client.
    """
    link, roles = model.spec.link, model.roles
    comes = any(message.direction == roles.received for message in model.messages.values())
    return {
        "baud": link.baud,
        "dataBits": link.data_bits,
        "parity": link.parity,
        "stopBits": link.stop_bits,
        "bitsPerByte": link.bits_per_byte,
        "localEcho": link.local_echo,
        "sent": roles.sent.key,
        "received": roles.received.key if comes else None,
        "client": roles.client,
        "device": roles.device,
        "exchanges": {each.request.name: _exchange(each) for each in model.exchanges},
    }


def _exchange(exchange: Exchange) -> dict[str, Any]:
    """Return what comes back; `largest` is the size of the largest frame that answers."""
    sizes = [each.size_at(each.counts[-1]) for each in exchange.answers]
    return {
        "reply": None if exchange.reply is None else exchange.reply.name,
        "refusal": None if exchange.refusal is None else exchange.refusal.name,
        "reports": list(exchange.reports),
        "echoed": [list(pair) for pair in exchange.echoed],
        "address": None if exchange.address is None else exchange.address.name,
        "silent": list(exchange.silent.values()),
        "largest": max(sizes, default=0),
    }
