"""An edition: one version of a spec, with its model, whatever today's rules say of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.compile import Compiled
    from framegen.language.spec import Spec
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


@dataclass(frozen=True, eq=False)
class Edition:
    """One version of a spec; `label` says where it is from, `v1.0.0:spec/busservo.yaml`."""

    label: str
    compiled: Compiled
    spec: Spec
    model: Model

    @property
    def version(self) -> str:
        """The version that it gives itself."""
        return self.spec.protocol.version

    def place(self, path: KeyPath) -> str:
        """Return where the key at `path` is: `spec/busservo.yaml:120:5`."""
        at = self.compiled.tree.key_at(path)
        return f"{self.label}:{at.line}:{at.column}"
