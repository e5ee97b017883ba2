"""Any change can be released: the spec then has the version that is due, and accepts its breaks.

Every edit is tried one way round, and the next day the other.
"""

import pytest
from framegen.comparison.comparison import Comparison
from framegen.comparison.due import due, version_finding
from framegen.comparison.listing import edition_of
from framegen.comparison.release import release
from framegen.compile import compile_spec
from framegen.reading.source import Source
from framegen.reading.yamltext import block

from tests.factories import Data
from tests.mutations.edits import EDITS, of_the_day


def text_of(data: Data) -> str:
    return "".join(f"{line}\n" for line in block(data))


@pytest.mark.parametrize("name", EDITS)
def test_a_released_spec_has_the_version_that_is_due(
    name: str, pytestconfig: pytest.Config
) -> None:
    old, new = of_the_day(name, pytestconfig.getoption("seed"))
    compiled = compile_spec(Source("spec/made_up.yaml", text_of(new)))
    before = compile_spec(Source("spec/released/made_up.yaml", text_of(old)))
    if compiled.findings or before.findings:
        pytest.skip("it contradicts itself")
    older = edition_of(before.source)
    comparison = Comparison(older, edition_of(compiled.source))
    if due(comparison.effects, comparison.changes) is None:
        pytest.skip("nothing but the version changed")
    made = release(compiled, comparison, {older.version}, accept="It is so.")
    released = compile_spec(Source("spec/made_up.yaml", made.text))
    assert released.findings == []
    again = Comparison(older, edition_of(released.source))
    assert [each.path for each in again.effects if each.breaks and not each.accepted] == []
    bump = due(again.effects, again.changes)
    assert version_finding(older.version, made.version, bump) is None
    assert released.spec.history[0].version == made.version
    assert released.spec.history[0].changes
