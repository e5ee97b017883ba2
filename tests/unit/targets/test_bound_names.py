"""Every name that a library binds is a good name for anything in a spec."""

import pytest
from framegen.checks import STRUCTURE_RULES
from framegen.language.package_names import why_taken
from framegen.render import render

from tests.bound_crowds import crowd_of
from tests.bound_names import imported, snake_names
from tests.crowd import Crowd
from tests.factories import compiled_of
from tests.names_at_work import at_work

# Classes meet what modules import, which depends on the kind of frames: some meet either here.
# tests/world/test_all_bound_names.py has every kind of name in frames of both kinds.
KINDS = {"fields ends messages": True, "halves elements": False, "parts": False}


@pytest.mark.parametrize("kinds", KINDS)
def test_a_library_works_whatever_its_names_are(kinds: str) -> None:
    at_work(compiled_of(crowd_of(*kinds.split(), plain=KINDS[kinds])))


def _called(name: str) -> Crowd:
    crowd = Crowd(name, "host", "device")
    crowd.command("Ask", [], reply="Answer")
    crowd.report("Answer", ["level"])
    return crowd


def test_no_protocol_hides_what_a_library_imports() -> None:
    assert {"numpy", "serial", "json"} <= imported()
    assert [name for name in imported() if not why_taken(name)] == ["__future__"]


def test_a_protocol_has_a_name_that_is_free_or_none() -> None:
    spec = compiled_of(_called("some_name").data).model.spec
    for name in snake_names():
        protocol = spec.protocol.model_copy(update={"name": name})
        named = spec.model_copy(update={"protocol": protocol})
        broken = {rule.id for rule in STRUCTURE_RULES for _ in rule.look(named)}
        assert broken - {"name-too-long"} == ({"protocol-name"} if why_taken(name) else set())


@pytest.mark.parametrize("name", ["messages", "decode", "device", "strategies", "json_lines", "u8"])
def test_all_that_is_made_for_a_protocol_has_its_name(name: str) -> None:
    compiled = compiled_of(_called(name).data)
    output = render(compiled)
    folders = {"/".join(path.split("/")[:-1]) for path in output.files}
    assert {folder.removeprefix("docs/reference/").split("/")[0] for folder in folders} == {
        "generated",
        name,
    }
    assert {path.split("/")[1] for path in output.files if path.startswith("generated/")} == {name}
    assert output.manifest == f"generated/{name}.manifest"
    at_work(compiled)
