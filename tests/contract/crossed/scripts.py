"""The codec of the pages under Node.js: one process for all protocols, one after the other."""

import json
from collections.abc import Callable
from pathlib import Path

from framegen.conformance.program import Program
from framegen.model.model import Model
from framegen.site.policy import script
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.protocol_data import protocol_data

from tests.contract.conformance.answerers import ANSWER
from tests.protocols.specs import model_of
from tests.unit.site.reference import NODE

# How long an answer may take: long, on a machine that does much else.
SECONDS = 60.0


class Scripts:
    """A process that answers questions about the protocol that it was told last."""

    def __init__(self, folder: Path) -> None:
        codec = folder / "codec.js"
        # A protocol with a checksum has all scripts.
        text = script(*codec_scripts(model_of("lxservo")))
        codec.write_text(text, encoding="utf-8")
        self._program = Program([str(NODE), str(ANSWER), str(codec)], SECONDS)

    def of(self, model: Model) -> Callable[[str], tuple[str, ...]]:
        """Tell of a protocol, and return what answers questions about it."""
        self._ask(f"protocol {json.dumps(protocol_data(model))}")
        return self._ask

    def _ask(self, question: str) -> tuple[str, ...]:
        reply = self._program.ask(question)
        if reply.failure:
            raise RuntimeError(f"{reply.failure}\n{self._program.last_words[-400:]}")
        return reply.lines

    def close(self) -> None:
        self._program.close()
