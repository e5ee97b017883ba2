"""A library of a protocol, as the runtime sees it: what its specification decides."""

from __future__ import annotations

import sys
from functools import cached_property

from ..edition import VERSION, refuse_others
from ..part import part_of

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing import TypeAlias

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.message import Message
    from ..line.hid_port import HidPort
    from ..line.link import Link
    from ..line.log import Log
    from ..line.serial_port import SerialPort
    from ..protocol.protocol import Protocol
    from .async_client import AsyncClient
    from .client import Client
    from .exchange import Exchange, Unaddressed
    from .limits import Limits
    from .pose import Pose

    Port: TypeAlias = SerialPort | HidPort
else:
    Port = object  # what opens a port is imported when one is opened


class Library:
    """What a generated library hands to the runtime.

    `package` is its import name, `edition` that of the runtime which it was generated for,
    `protocol_version` the version of the specification, and `client` the class of its client for
    threads. What takes time to import is imported when it is first asked for. Raises ImportError
    for an edition that this runtime does not serve.
    """

    def __init__(
        self,
        package: str,
        *,
        edition: int,
        protocol_version: str,
        link: Link,
        codec: ProtocolCodec,
        client: str = "Controller",
    ) -> None:
        refuse_others(edition, package)
        self.package = package
        self.protocol_version = protocol_version
        self.link = link
        self.codec = codec
        self._client = client

    def __repr__(self) -> str:
        return f"<the library {self.package} of protocol version {self.protocol_version}>"

    @cached_property
    def log(self) -> Log:
        """What returns its logger."""
        from ..line.log import Log

        return Log(self.package)

    @cached_property
    def exchanges(self) -> dict[type[Message], Exchange]:
        """What answers each message that a client sends, and the method that sends it."""
        exchanges: dict[type[Message], Exchange] = part_of(self.package, "_exchanges").EXCHANGES
        return exchanges

    @cached_property
    def answers(self) -> dict[type[Message], Unaddressed]:
        """The messages that answer anything, each with what tells which device it is from."""
        return {kind: each.address for each in self.exchanges.values() for kind in each.kinds}

    @cached_property
    def reports(self) -> frozenset[type[Message]]:
        """The messages that a device may send without being asked, behind some command."""
        return frozenset(kind for each in self.exchanges.values() for kind in each.reports)

    @cached_property
    def acknowledging(self) -> frozenset[type[Message]]:
        """Those of them that acknowledge a command."""
        kinds = (each.acknowledged for each in self.exchanges.values())
        return frozenset(kind for kind in kinds if kind is not None)

    @cached_property
    def limits(self) -> Limits:
        """The limits of what a client sends unless it is told otherwise."""
        limits: Limits = part_of(self.package, "_exchanges").LIMITS
        return limits

    @cached_property
    def pose(self) -> Pose | None:
        """How positions are read, commanded and released; None for a protocol without positions."""
        pose: Pose | None = part_of(self.package, "_exchanges").POSE
        return pose

    @cached_property
    def client(self) -> type[Client]:
        """The client for threads."""
        client: type[Client] = getattr(part_of(self.package, "_controller"), self._client)
        return client

    @cached_property
    def async_client(self) -> type[AsyncClient]:
        """The client for asyncio."""
        module = part_of(self.package, "_async_controller")
        client: type[AsyncClient] = getattr(module, f"Async{self._client}")
        return client

    def open_transport(
        self, port: str, *, baud: float | None = None, exclusive: bool = True
    ) -> Port:
        """Open a port, by the name or the URL that pyserial knows it by, or a device by `hid://`.

        The parameters of the line are the protocol's, and so is its rate without a `baud`; one of
        math.inf says that the line takes no time, and sets the port to the protocol's rate. With
        `exclusive`, no other program that also asks for exclusive use can have the port meanwhile.
        Raises TransportError; ValueError for a `baud` that no port can be set to.
        """
        from ..line.serial_port import open_port

        rate = self.link.baud if baud is None else baud
        return open_port(port, self.link, self.codec, baud=rate, exclusive=exclusive)

    @property
    def version(self) -> str:
        """The version of the installed package, or else of the specification."""
        from pathlib import Path

        from .version import version_of

        file = str(sys.modules[self.package].__file__)
        return version_of(Path(file).absolute().parent, self.protocol_version)

    @property
    def versions(self) -> str:
        """Its version, that of the specification, and that of the runtime and how it came."""
        whose = "its own" if __name__.startswith(f"{self.package}.") else "shared"
        return f"{self.version}, spec {self.protocol_version}, {whose} runtime {VERSION}"

    def protocol(self) -> Protocol:
        """Read all that is known of the protocol, for whoever explains it."""
        return self.codec.protocol()
