"""The targets of our own rows: the bar that must not be missed, and the goal."""

from __future__ import annotations

from dataclasses import dataclass

from benchmarks.results import (
    AS_COLUMNS,
    AS_TABLES,
    AT_HAND,
    BY_CLASS,
    CLIENT,
    DICTS,
    EVERY_FIELD,
    GENERATED,
    IN_USE,
    OURS,
)


@dataclass(frozen=True)
class Target:
    """The target of one of our rows; a row without bar and goal is only reported."""

    row: str
    contender: str
    text: str
    bar: float | None = None
    goal: float | None = None

    def verdict(self, value: float) -> str:
        """Return PASS or over, by the bar; name a goal that is reached."""
        by_bar = [] if self.bar is None else ["PASS" if value <= self.bar else "over"]
        by_goal = [] if self.goal is None or value > self.goal else ["goal"]
        return ", ".join(by_bar + by_goal)


TARGETS = (
    # The bars are those of a message at hand: benchmarks/README.md tells why.
    Target("encode-1", AT_HAND, "validated encode, 1 servo", 1.0, 0.90),
    Target("encode-6", AT_HAND, "validated encode, 6 servos", 1.05, 0.97),
    Target("encode-32", AT_HAND, "validated encode, 32 servos", 1.2, 1.08),
    Target("encode-1", OURS, "construct, validate and encode, 1 servo", goal=2.2),
    Target("encode-6", OURS, "construct, validate and encode, 6 servos", goal=1.5),
    Target("encode-32", OURS, "construct, validate and encode, 32 servos", goal=1.65),
    Target("decode-6", OURS, "decode a 6-servo reply", 3.1, 0.65),
    Target("decode-6", BY_CLASS, "decode a 6-servo reply, class known"),
    Target("decode-6", EVERY_FIELD, "decode a 6-servo reply, every field by its name"),
    Target("decode-6", AS_COLUMNS, "decode a 6-servo reply, every field as columns"),
    Target("decode-battery", OURS, "decode a battery reply", 4.1, 3.4),
    Target("decode-battery", BY_CLASS, "decode a battery reply, class known"),
    Target("decode-battery", EVERY_FIELD, "decode a battery reply, every field read"),
    Target("stream-clean-65536", OURS, "stream, chunks of 65536", 1.7, 0.45),
    Target("stream-clean-64", OURS, "stream, chunks of 64", 1.85, 0.90),
    Target("stream-clean-1", OURS, "stream, chunks of 1", 0.58, 0.45),
    # The bars are those of plain values: benchmarks/README.md tells why.
    Target("stream-clean-65536", AS_COLUMNS, "chunks of 65536, every field as columns", 1.6, 1.25),
    Target("stream-clean-64", AS_COLUMNS, "chunks of 64, every field as columns", 1.7, 1.55),
    Target("stream-clean-1", AS_COLUMNS, "chunks of 1, every field as columns", 0.60, 0.56),
    Target("stream-clean-65536", EVERY_FIELD, "chunks of 65536, every field by its name", goal=1.0),
    Target("stream-clean-64", EVERY_FIELD, "chunks of 64, every field by its name", goal=1.6),
    Target("stream-clean-1", EVERY_FIELD, "chunks of 1, every field by its name", goal=0.55),
    Target("noise-garbage", OURS, "stream with garbage, against our own clean one", 1.10, 1.05),
    Target(
        "noise-flipped", OURS, "stream with flipped bits, against our own clean one", 1.10, 1.05
    ),
    Target("lxservo-decode", GENERATED, "a sum: decode Move, 10 bytes, two ranges", 2.4, 2.1),
    Target("lxservo-reply", GENERATED, "a sum: decode PreparedMove, 10 bytes", 2.4, 1.6),
    Target("lxservo-stream", GENERATED, "a sum: stream of Move", 1.3, 1.2),
    Target("dynamixel1-decode", GENERATED, "a sum: decode Status, 10 bytes, a list", 2.4, 1.6),
    Target("dynamixel1-stream", GENERATED, "a sum: stream of Status", 1.3, 1.2),
    Target("modbus-decode", GENERATED, "a table CRC: decode Holding, 11 bytes, a list", 1.7, 1.5),
    Target("modbus-question", GENERATED, "a table CRC: decode HoldingRead, 8 bytes", 1.7, 1.6),
    Target("modbus-stream", GENERATED, "a table CRC: stream of Holding", 1.3, 1.2),
    Target("ubx-decode", GENERATED, "two sums: decode AckAck, 10 bytes"),
    Target("ubx-stream", GENERATED, "two sums: stream of AckAck"),
    Target("import", OURS, "import, ms over bare Python", 5.0, 0.2),
    Target("import", IN_USE, "import what decodes, ms over bare Python", goal=4.5),
    Target("import", CLIENT, "import the client, ms over bare Python", goal=15),
    Target("command-text", OURS, "busservo decode, CPU seconds a megabyte", goal=0.5),
    Target("command-json", OURS, "busservo decode --json, CPU seconds a megabyte", goal=0.5),
    Target("columns-clean", AS_TABLES, "a capture as columns, CPU ms a megabyte", 10.0),
    Target("columns-clean-share", DICTS, "a capture as columns, against objects", round(1 / 30, 3)),
    Target("columns-parquet", AS_TABLES, "a capture as Parquet, CPU ms a megabyte", goal=12.0),
    Target("generate", OURS, "framegen generate, CPU seconds", 0.5, 0.30),
)
