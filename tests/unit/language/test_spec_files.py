"""Spec files: how they are read, and what is refused."""

from pathlib import Path

import pytest
from framegen.compile import compile_spec
from framegen.language.load import MAX_BYTES, read_source
from framegen.reading.source import Source
from framegen.reading.yamltree import Unusable

from tests.bad_specs import bad_spec
from tests.factories import BUSSERVO, DEMO
from tests.in_turn import in_turn


@pytest.mark.parametrize("file", [BUSSERVO, DEMO], ids=lambda file: file.stem)
def test_a_good_spec_is_clean(file: Path) -> None:
    assert compile_spec(read_source(file)).findings == []


@pytest.mark.parametrize("slip", ["", "\nnothing: known"], ids=["good", "bad"])
def test_what_is_loaded_keeps_its_text_and_its_places(slip: str) -> None:
    source = Source("demo.yaml", DEMO.read_text(encoding="utf-8") + slip)
    compiled = compile_spec(source)
    assert compiled.source is source
    assert compiled.tree.key_at(("protocol",)).line > 1
    assert (compiled.read is None) == bool(slip)


EMPTY = "the file is empty, but a spec is a mapping of keys"
BEGIN = "begin with `framegen: 2` and `protocol:`; `framegen schema` prints the whole language"
UTF_8, LARGE = "is not UTF-8 text: byte", "has 1.0 MB, and a spec has at most 1 MB"


@in_turn(
    "data, said, hint",
    lambda: [
        (None, "{} does not exist", "name a spec file, or run this where spec/*.yaml is"),
        ("", "{} is not a file", "name the spec itself, such as spec/busservo.yaml"),
        (b"", EMPTY, BEGIN),
        (b"\n\n", EMPTY, BEGIN),
        (b"framegen: 1\n\xff", f"{{}} {UTF_8} 12 is 0xFF", "save it as UTF-8"),
        (bytes(range(128, 256)), f"{{}} {UTF_8} 0 is 0x80", "save it as UTF-8"),
        (b"\x7fELF\x02\x01\x00", "the file is not YAML", ""),
        (b"#" * (MAX_BYTES + 1), f"{{}} {LARGE}", "is it the right file?"),
    ],
)
def test_a_file_that_is_no_spec_is_refused_with_what_to_do(
    tmp_path: Path, data: bytes | str | None, said: str, hint: str
) -> None:
    file = tmp_path if data == "" else tmp_path / "spec.yaml"
    if isinstance(data, bytes):
        file.write_bytes(data)
    with pytest.raises(Unusable) as refused:
        compile_spec(read_source(file))
    assert str(refused.value).startswith(said.format(file.as_posix()))
    assert refused.value.hint == hint


@pytest.mark.parametrize(
    ("error", "reason"),
    [
        (PermissionError(13, "Permission denied"), "Permission denied"),
        (ValueError("embedded null byte"), "embedded null byte"),
    ],
)
def test_a_file_that_cannot_be_read_is_refused_with_the_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: Exception, reason: str
) -> None:
    def unreadable(_: Path) -> bytes:
        raise error

    file = tmp_path / "spec.yaml"
    file.write_bytes(b"framegen: 1")
    monkeypatch.setattr(Path, "read_bytes", unreadable)
    with pytest.raises(Unusable) as refused:
        read_source(file)
    assert str(refused.value) == f"{file.as_posix()} cannot be read: {reason}"


def test_a_file_of_the_largest_size_is_read(tmp_path: Path) -> None:
    file = tmp_path / "spec.yaml"
    file.write_bytes(b"#" * MAX_BYTES)
    source = read_source(file)
    assert (source.name, len(source.text)) == (file.as_posix(), MAX_BYTES)


@pytest.mark.parametrize("start", [b"", b"\xef\xbb\xbf"], ids=["plain", "byte order mark"])
@pytest.mark.parametrize("end", [b"\n", b"\r\n"], ids=["lf", "crlf"])
def test_line_ends_and_a_first_mark_change_nothing(
    tmp_path: Path, start: bytes, end: bytes
) -> None:
    bad = bad_spec("duplicate-id")
    plain = bad.source.text.encode()
    file = tmp_path / "spec.yaml"
    file.write_bytes(start + plain.replace(b"\n", end))
    source = read_source(file)
    assert source.text.encode() == plain
    assert compile_spec(source).findings == bad.findings
