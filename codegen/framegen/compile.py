"""Compile a spec: read its text, check it, and derive its model, once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.checks import check_model, check_structure
from framegen.language.load import load
from framegen.language.spec import AddressPart, ListField
from framegen.model.model import derive
from framegen.reading.findings import in_order
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from framegen.language.load import Loaded
    from framegen.language.spec import AnyField, Spec
    from framegen.model.model import Model
    from framegen.reading.findings import Finding
    from framegen.reading.source import Source
    from framegen.reading.yamltree import Tree


@dataclass(frozen=True, slots=True)
class Compiled:
    """A spec as text, with the place of each value, its findings and its model.

    `tolerated` are findings that do not count: what today's rules say of an edition of old. If it
    `carries_runtime`, its library brings what all of them have in common, and needs nothing else.
    """

    source: Source
    tree: Tree
    findings: list[Finding]
    read: Spec | None
    derived: Model | None
    tolerated: tuple[Finding, ...] = ()
    carries_runtime: bool = False

    @property
    def spec(self) -> Spec:
        """The spec as its author wrote it. Raises Unusable where there are findings."""
        return self.model.spec

    @property
    def model(self) -> Model:
        """The model that follows from it. Raises Unusable where there are findings."""
        if self.findings or self.derived is None:
            name = self.source.name
            first = self.findings[0].render(self.source)
            raise Unusable(
                f"{name} has {pluralize(len(self.findings), 'finding')}; the first is\n{first}",
                hint=f"`framegen check {name}` shows them all",
            )
        return self.derived


def compile_spec(source: Source) -> Compiled:
    """Read and check a spec, and derive its model. Raises Unusable where it is no spec.

    What is wrong is in `findings`, from the top of the file down.
    """
    return compile_loaded(load(source))


def compile_leniently(source: Source) -> Compiled:
    """Compile a spec that rules may dislike: if it has a model, their findings are `tolerated`.

    Where none can be derived, they are findings as ever. Raises Unusable where it is no spec.
    """
    compiled = compile_spec(source)
    if not compiled.findings or compiled.read is None:
        return compiled
    model = compiled.derived
    if model is None:
        try:
            model = derive(compiled.read)
        except Exception:  # noqa: BLE001 - what may go wrong is what the rules are there to say
            return compiled
    return replace(compiled, findings=[], derived=model, tolerated=tuple(compiled.findings))


def compile_loaded(loaded: Loaded) -> Compiled:
    """Check a spec that has been read, and derive its model."""
    found, spec, model = list(loaded.findings), loaded.spec, None
    if spec is not None:
        structure = check_structure(spec, loaded.tree)
        found += structure
        if not structure:
            model = derive(spec)
            found += check_model(model, loaded.tree)
    return Compiled(loaded.source, loaded.tree, in_order(found), spec, model)


def without_bounds(model: Model) -> Model:
    """Return the model of the same spec in which numbers may have any value of their type.

    Lists may have any number of elements. It tells what frames say that a spec does not allow.
    """
    spec = model.spec
    messages = {
        name: message.model_copy(
            update={"fields": {key: _unbounded(field) for key, field in message.fields.items()}}
        )
        for name, message in spec.messages.items()
    }
    frames = {
        name: {
            key: part.model_copy(update={"range": None}) if isinstance(part, AddressPart) else part
            for key, part in frame.items()
        }
        for name, frame in spec.envelopes.items()
    }
    envelopes = {"frames": frames} if spec.frames else {"frame": frames["frame"]}
    return derive(spec.model_copy(update={"messages": messages, **envelopes}))


def _unbounded(field: AnyField) -> AnyField:
    counted = field.counted_by is not None or field.sized_by is not None
    count = None if counted else field.count
    if isinstance(field, ListField):
        inner = {name: _unbounded(each) for name, each in field.fields.items()}
        return field.model_copy(update={"fields": inner, "count": count})
    return field.model_copy(update={"range": None, "always": None, "count": count})


def placed(error: Unusable, source: Source) -> Unusable:
    """Return why a text is no spec, with its name and with the place, where there is one."""
    place = "" if error.finding is None else f"\n{error.finding.render(source)}"
    return Unusable(f"{source.name}: {error}{place}", hint=error.hint)
