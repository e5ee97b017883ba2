"""Checksums in the page, under node: compared with the catalogue, and each byte summed once."""

import random

import pytest
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import NumberField
from framegen.model.checksums import CHECK_DATA, CHECKSUMS
from framegen.model.slots import Number
from framegen.site.scripts.slot_data import checksum_method

from tests.unit.site.reference import NODE
from tests.unit.site.scripts import run_script

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

METHODS = [(name, width) for name, method in CHECKSUMS.items() for width in method.widths]

OF_PIECES = """
const answers = asked.map(([method, bytes, pieces]) => makeChecksum(method, bytes)(
  pieces.map((piece) => (piece.length === 2 ? piece : { unsent: piece }))));
"""
# How often each byte is read, where every stretch of the bytes is summed.
READS = """
const answers = asked.map(([method, bytes]) => {
  const reads = bytes.map(() => 0);
  const counted = new Proxy(bytes, { get(target, at) {
    if (at in reads) reads[at]++;
    return target[at];
  } });
  const checksum = makeChecksum(method, counted);
  for (let start = 0; start < bytes.length; start++) {
    for (let end = start; end <= bytes.length; end++) checksum([[start, end]]);
  }
  return reads;
});
"""


def part(name: str, width: int) -> Number:
    """Return the part of a frame that holds a checksum."""
    kind = NUMBER_TYPES[f"u{width}"]
    field = NumberField.model_validate({"type": kind.name, "about": ""})
    return Number("sum", "checksum", 0, kind, "little", field, method=name)


def test_every_method_of_the_catalogue_gives_its_check_value() -> None:
    asked = [
        (checksum_method(part(name, width)), CHECK_DATA, [[0, len(CHECK_DATA)]])
        for name, width in METHODS
    ]
    expected = [CHECKSUMS[name].checks[width] for name, width in METHODS]
    assert run_script(["checksums"], OF_PIECES, asked) == expected


def test_pieces_and_bytes_that_are_not_sent_are_summed_as_one() -> None:
    chance = random.Random(4)  # noqa: S311 - the same bytes in every run
    asked, expected = [], []
    for name, width in METHODS:
        data, unsent = chance.randbytes(40), chance.randbytes(3)
        start, middle, end = sorted(chance.sample(range(41), 3))
        pieces = [[middle, end], [*unsent], [start, middle], [end, end]]
        asked.append((checksum_method(part(name, width)), data, pieces))
        covered = data[middle:end] + unsent + data[start:middle]
        expected.append(CHECKSUMS[name].of(covered, width))
    assert run_script(["checksums"], OF_PIECES, asked) == expected


def test_each_byte_is_read_once_however_many_stretches_it_is_in() -> None:
    data = bytes(range(40))
    asked = [(checksum_method(part(name, width)), data) for name, width in METHODS]
    assert run_script(["checksums"], READS, asked) == [[1] * len(data)] * len(METHODS)
