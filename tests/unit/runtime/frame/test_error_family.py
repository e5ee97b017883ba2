"""The errors of all libraries that share the runtime: one family, with names in one place."""

from collections.abc import Iterator

import busservo
import framewire
import lxservo
import pytest


def below(kind: type[framewire.ProtocolError]) -> Iterator[type[framewire.ProtocolError]]:
    yield kind
    for each in kind.__subclasses__():
        yield from below(each)


def test_every_error_is_named_by_the_runtime() -> None:
    for name in framewire.__all__:
        assert getattr(framewire, name).__name__ == name
    ours = {kind for kind in below(framewire.ProtocolError) if kind.__module__ == "framewire"}
    assert {kind.__name__ for kind in ours} == set(framewire.__all__)


@pytest.mark.parametrize("library", [busservo, lxservo])
def test_the_errors_of_a_library_are_those_of_all(library: object) -> None:
    names = [name for name in framewire.__all__ if hasattr(library, name)]
    assert len(names) > 15
    assert [getattr(library, name) for name in names] == [
        getattr(framewire, name) for name in names
    ]
    with pytest.raises(AttributeError, match="has no attribute 'NoSuchError'"):
        _ = framewire.NoSuchError  # type: ignore[attr-defined]
