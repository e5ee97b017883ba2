"""What others wrote for the same protocols, from the package index: each writes and reads frames.

A peer is asked for as many messages as it knows, on a line that ends in this process. What it
cannot say is narrowed to what it can.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.protocols.actuator_sdk import DynamixelSdk
from tests.protocols.receiver_messages import Pyubx2
from tests.protocols.register_messages import Pymodbus
from tests.protocols.servo_clients import LewansoulLx16a, Pylx16a

if TYPE_CHECKING:
    from tests.protocols.peer import Peer

PEERS: list[type[Peer]] = [LewansoulLx16a, Pylx16a, DynamixelSdk, Pymodbus, Pyubx2]
