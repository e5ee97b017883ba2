"""Owners of files: what framegen wrote, what somebody edited, and what somebody else put there."""

import os
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from framegen.output import Output, banner
from framegen.reading.yamltree import Unusable
from framegen.vendored import RECORD
from framegen.writing import Change, changes, survey, write

from tests.unit.writing.trees import (
    AFTER,
    BANNER,
    BEFORE,
    BROUGHT,
    LIBRARY,
    NEWER,
    OLDER,
    PAGES,
    SPEC,
    output,
    put,
    schema,
    snapshot,
)

MANIFEST = "generated/kiln.manifest"
CHANGED, NEW = f"{LIBRARY}/changed.py", f"{LIBRARY}/new.py"


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """Return a root with the first edition in it."""
    write(tmp_path, [BEFORE])
    return tmp_path


def fresh(folder: Path, *outputs: Output) -> dict[str, bytes | None]:
    """Return what lies in a folder where there was nothing, which is no loss."""
    assert write(folder, list(outputs)).notices == []
    return snapshot(folder)


def whys(found: list[Change]) -> dict[str, str]:
    return {change.path: change.why for change in found if change.path != MANIFEST}


# ------------------------------------------------------------------ own files


def test_changes_are_reported_with_their_reasons(root: Path) -> None:
    expected = {
        CHANGED: "stale",
        NEW: "missing",
        f"{LIBRARY}/deep/er/new.py": "missing",
        f"{LIBRARY}/gone.py": "orphaned",
        f"{LIBRARY}/old/inner.py": "orphaned",
        f"{PAGES}/messages/Heat.md": "stale",
        f"{PAGES}/messages/Fan.md": "missing",
        f"{PAGES}/messages/Cool.md": "orphaned",
    }
    before = snapshot(root)
    assert whys(changes(root, [AFTER])) == expected
    assert snapshot(root) == before
    assert whys(write(root, [AFTER]).changes) == expected
    assert changes(root, [AFTER]) == []


def test_there_and_back_is_as_if_nothing_had_been(root: Path, tmp_path: Path) -> None:
    first = snapshot(root)
    write(root, [AFTER])
    assert snapshot(root) == fresh(tmp_path / "elsewhere", AFTER)
    shutil.rmtree(tmp_path / "elsewhere")
    write(root, [BEFORE])
    assert snapshot(root) == first


def test_what_python_made_of_a_module_goes_with_it(root: Path, tmp_path: Path) -> None:
    for module in ("gone", "same", "old/inner"):
        folder, _, name = module.rpartition("/")
        put(root, f"{LIBRARY}/{folder}/__pycache__/{name}.cpython-311.pyc", "\0")
    write(root, [AFTER])
    left = {path for path in snapshot(root) if path.endswith(".pyc")}
    assert left == {f"{LIBRARY}/__pycache__/same.cpython-311.pyc"}
    assert not (root / LIBRARY / "old").exists()


def test_a_file_that_is_gone_comes_back(root: Path) -> None:
    before = snapshot(root)
    shutil.rmtree(root / "generated" / "kiln")
    assert set(whys(write(root, [BEFORE]).changes).values()) == {"missing"}
    assert snapshot(root) == before


def test_line_ends_of_a_checkout_are_no_edit(root: Path) -> None:
    for path, data in snapshot(root).items():
        if data is not None:
            (root / path).write_bytes(data.replace(b"\n", b"\r\n"))
    assert changes(root, [BEFORE]) == []
    assert set(whys(changes(root, [AFTER])).values()) == {"stale", "missing", "orphaned"}
    write(root, [AFTER])
    assert changes(root, [AFTER]) == []


@pytest.mark.parametrize("data", ["", "\0" * 100])
def test_a_file_that_lost_what_it_held_is_no_edit(root: Path, data: str) -> None:
    """As a file may that was new when the power went."""
    for name in ("changed", "gone"):
        put(root, f"{LIBRARY}/{name}.py", data)
    write(root, [AFTER])
    assert changes(root, [AFTER]) == []


def test_orphans_of_any_kind_are_known(root: Path) -> None:
    """By the manifest, since no page of HTML, no JSON and no empty file says whose it is."""
    files = {f"{LIBRARY}/{name}": "" for name in ("a.html", "b.json", "py.typed", "c")}
    wider = replace(BEFORE, files={**BEFORE.files, **files})
    write(root, [wider])
    assert whys(write(root, [BEFORE]).changes) == dict.fromkeys(files, "orphaned")


def test_a_name_that_changes_its_capitals_alone_keeps_its_file(root: Path) -> None:
    """Also where capitals do not distinguish names: the orphan is then the wanted file itself."""
    other = output(same="x = 1\n", Heat="old")
    page = f"{PAGES}/messages/Heat.md"
    renamed = replace(
        other, files={path.replace("Heat", "HEAT"): t for path, t in other.files.items()}
    )
    write(root, [other])
    twin = root / page.replace("Heat", "HEAT")
    if not twin.exists():  # where names that differ in capitals are two files
        shutil.copyfile(root / page, twin)
    done = write(root, [renamed]).changes
    assert whys(done) == {page: "orphaned", page.replace("Heat", "HEAT"): "stale"}
    assert twin.exists()


# ------------------------------------------------------------------ edits and files of others


# What somebody has put where, and what it is called.
OTHERS = {
    "edited by hand": (CHANGED, f"{BEFORE.files[CHANGED]}# mine\n", "edited by hand"),
    "an orphan edited by hand": (f"{LIBRARY}/gone.py", "# mine\n", "edited by hand"),
    "a file of somebody else": (NEW, "# mine\n", "foreign"),
    # Though it has the banner, the manifest says that framegen wrote none there.
    "a copy": (NEW, f"{BANNER}x = 3\n", "foreign"),
    # Nothing is lost where framegen wrote something; here it did not.
    "a blank file": (NEW, "", "foreign"),
    "no text": (CHANGED, "\udcff\udcfe\0", "edited by hand"),
}


@pytest.mark.parametrize("name", OTHERS)
def test_foreign_files_are_never_replaced_or_removed_and_with_force_kept_beside(
    root: Path, tmp_path: Path, name: str
) -> None:
    path, text, why = OTHERS[name]
    data = put(root, path, text).read_bytes()
    put(root, f"{path}.mine", "kept before\n")
    before = snapshot(root)
    assert whys(changes(root, [AFTER]))[path] == why
    with pytest.raises(Unusable) as caught:
        write(root, [AFTER])
    assert f"  {why}: {path}" in str(caught.value)
    assert str(caught.value).startswith("somebody's work would be lost, so nothing was written")
    assert "--force" in caught.value.hint
    assert snapshot(root) == before
    done = write(root, [AFTER], force=True)
    assert done.kept == {path: f"{path}.mine-2"}
    found = snapshot(root)
    assert found.pop(f"{path}.mine") == b"kept before\n"
    assert found.pop(f"{path}.mine-2") == data
    assert found == fresh(tmp_path / "elsewhere", AFTER)
    shutil.rmtree(tmp_path / "elsewhere")
    found_now = survey(root, [AFTER])
    assert (found_now.changes, found_now.strangers) == ([], [])


def test_an_edit_equal_to_the_new_output_is_no_edit(root: Path) -> None:
    """Whoever has anticipated the output has nothing to lose."""
    put(root, CHANGED, AFTER.files[CHANGED])
    put(root, NEW, AFTER.files[NEW])
    write(root, [AFTER])
    assert changes(root, [AFTER]) == []


def test_the_first_of_many_files_in_the_way_are_named(root: Path) -> None:
    wide = output(**{f"m{n}": "x = 1\n" for n in range(30)})
    for path in wide.files:
        put(root, path, "mine\n")
    with pytest.raises(Unusable) as caught:
        write(root, [wide])
    assert str(caught.value).count("foreign: ") == 20
    assert str(caught.value).endswith("  and 10 more files")


LITTER = ["__pycache__/same.cpython-311.pyc", ".DS_Store", "Thumbs.db"]


@pytest.mark.parametrize("name", [*LITTER, "same.py.mine", "same.py.mine-12"])
def test_litter_and_kept_files_are_not_foreign(root: Path, name: str) -> None:
    put(root, f"{LIBRARY}/{name}", "\0")
    assert survey(root, [BEFORE]).strangers == []
    write(root, [AFTER])
    assert (root / LIBRARY / name).exists()


def test_files_beside_the_output_are_ignored(root: Path) -> None:
    for path in ("generated/other/mine.py", "generated/notes.md", "docs/a.md", "mine.py"):
        put(root, path, "mine\n")
    found = survey(root, [BEFORE])
    assert (found.changes, found.strangers) == ([], [])


# ------------------------------------------------------------------ the manifest


def test_the_manifest_reads_as_sha256sum_writes(root: Path) -> None:
    lines = (root / MANIFEST).read_text(encoding="utf-8").splitlines()
    assert lines[:2] == [f"# {banner(SPEC)}", f"# spec: {SPEC}"]
    assert lines[2] == f"# spec-sha256: {BEFORE.digest}"
    paths = [line[66:] for line in lines if not line.startswith("#")]
    assert paths == sorted(BEFORE.files)


def _conflicted(data: bytes) -> bytes:
    *lines, last = data.splitlines(keepends=True)
    theirs = last.replace(last[:64], b"0" * 64)
    return b"".join([*lines, b"<<<<<<< ours\n", last, b"=======\n", theirs, b">>>>>>> theirs\n"])


DAMAGES: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda _data: b"",
    "cut": lambda data: data[:-50],
    "conflicted": _conflicted,
    "binary": lambda _data: b"\xff\xfe\0",
}


@pytest.mark.parametrize("edition", [BEFORE, AFTER], ids=["the same", "the next"])
@pytest.mark.parametrize("damage", ["gone", *DAMAGES])
def test_a_manifest_that_is_lost_or_damaged_is_made_anew(
    root: Path, tmp_path: Path, damage: str, edition: Output
) -> None:
    file = root / MANIFEST
    if damage == "gone":
        file.unlink()
    else:
        file.write_bytes(DAMAGES[damage](file.read_bytes()))
    state = "is not there" if damage == "gone" else "is damaged"
    done = write(root, [edition])
    assert done.notices == [f"{MANIFEST} {state}: files are recognised by their contents"]
    assert snapshot(root) == fresh(tmp_path / "elsewhere", edition)


def test_without_a_manifest_a_file_of_somebody_else_is_not_adopted(root: Path) -> None:
    (root / MANIFEST).unlink()
    put(root, NEW, "# mine\n")
    with pytest.raises(Unusable, match=f"foreign: {NEW}"):
        write(root, [AFTER])


def test_files_with_merge_conflicts_are_no_edits(root: Path) -> None:
    conflict = f"{BANNER}<<<<<<< ours\nx = 1\n=======\nx = 2\n>>>>>>> theirs\n"
    put(root, CHANGED, conflict)
    put(root, NEW, conflict)
    put(root, f"{LIBRARY}/gone.py", conflict)
    found = whys(changes(root, [AFTER]))
    assert found[CHANGED] == found[NEW] == "conflicted"
    assert found[f"{LIBRARY}/gone.py"] == "orphaned"
    write(root, [AFTER])
    assert changes(root, [AFTER]) == []


def test_after_a_conflict_the_manifest_says_what_it_said(root: Path) -> None:
    before = snapshot(root)
    put(root, CHANGED, "<<<<<<< a\n=======\n>>>>>>> b\n")
    write(root, [BEFORE])
    assert snapshot(root) == before


def test_two_manifests_that_git_has_joined_know_the_files_of_both(root: Path) -> None:
    """As .gitattributes asks for: the lines of both sides."""
    ours = (root / MANIFEST).read_text(encoding="utf-8").splitlines()
    write(root, [AFTER])
    theirs = (root / MANIFEST).read_text(encoding="utf-8").splitlines()
    joined = [*ours, *(line for line in theirs if line not in ours)]
    put(root, MANIFEST, "\n".join(joined) + "\n")
    for path in (CHANGED, f"{LIBRARY}/gone.py"):
        put(root, path, BEFORE.files[path])
    # And what git has joined of both is no edit, either.
    joined_page = f"{PAGES}/messages/Heat.md"
    put(root, joined_page, AFTER.files[joined_page] + BEFORE.files[joined_page])
    edited = f"{LIBRARY}/same.py"
    put(root, edited, f"{BEFORE.files[edited]}# mine\n")
    assert whys(changes(root, [AFTER])) == {
        CHANGED: "stale",
        f"{LIBRARY}/gone.py": "orphaned",
        joined_page: "stale",
        edited: "edited by hand",
    }
    put(root, edited, BEFORE.files[edited])
    assert write(root, [AFTER]).notices == []
    assert changes(root, [AFTER]) == []


@pytest.mark.parametrize(
    "path", ["/etc/x", "../x", "a/../../x", "a\\..\\x", "C:/x", "./x", "a//x", "a/", ".", ".."]
)
def test_a_manifest_line_that_leads_out_is_damage(root: Path, path: str) -> None:
    file = root / MANIFEST
    file.write_text(file.read_text(encoding="utf-8") + f"{'0' * 64}  {path}\n", encoding="utf-8")
    assert survey(root, [BEFORE]).notices != []


# ------------------------------------------------------------------ what is brought as it is


def brought(found: list[Change]) -> dict[str, str]:
    return {
        path.removeprefix(f"{BROUGHT}/"): why
        for path, why in whys(found).items()
        if path.startswith(BROUGHT)
    }


def listed(root: Path) -> list[str]:
    lines = (root / MANIFEST).read_text(encoding="utf-8").splitlines()
    return [line.partition("  ")[2] for line in lines if BROUGHT in line]


UPDATED = {
    RECORD: "stale",
    "changed.py": "stale",
    "old/gone.py": "orphaned",
    "new.py": "missing",
}
EDITED = "edited by hand"
# Of the files of an older version, where nothing says any more that they are.
UNKNOWN = {"changed.py": "foreign", "old/gone.py": None}
RECORDED = f"{BROUGHT}/{RECORD}"
BOTH = f"<<<<<<< a\n{OLDER.files[RECORDED]}=======\n{NEWER.files[RECORDED]}>>>>>>> b\n"


def test_one_line_of_the_manifest_is_of_what_is_brought(tmp_path: Path) -> None:
    write(tmp_path, [OLDER])
    assert listed(tmp_path) == [RECORDED]
    assert brought(changes(tmp_path, [NEWER])) == UPDATED
    write(tmp_path, [NEWER])
    assert (listed(tmp_path), changes(tmp_path, [NEWER])) == ([RECORDED], [])
    assert fresh(tmp_path / "other", NEWER) == fresh(tmp_path / "third", NEWER)
    # A run for another target leaves it alone, and knows it afterwards.
    pages = {path: text for path, text in NEWER.files.items() if path.startswith(PAGES)}
    others = {path: text for path, text in NEWER.files.items() if path not in pages}
    assert changes(tmp_path, [replace(NEWER, files=pages, others=others, folders=(PAGES,))]) == []
    # A library without it takes all of it away.
    write(tmp_path, [AFTER])
    assert not (tmp_path / BROUGHT).exists()


@pytest.mark.parametrize(
    ("name", "text", "older", "newer"),
    [
        ("same.py", "# mine\n", {"same.py": EDITED}, {"same.py": EDITED}),
        ("changed.py", "# mine\n", {"changed.py": EDITED}, {"changed.py": EDITED}),
        ("old/gone.py", None, {"old/gone.py": "missing"}, {"old/gone.py": None}),
        ("more.py", "# mine\n", {}, {}),
        (RECORD, None, {RECORD: "missing"}, {RECORD: "missing", **UNKNOWN}),
        (RECORD, "# mine\n", {RECORD: EDITED}, {RECORD: EDITED, **UNKNOWN}),
        (RECORD, BOTH, {RECORD: "conflicted"}, {RECORD: "conflicted"}),
        ("../../kiln.manifest", None, {}, {}),
        ("../../kiln.manifest", "half", {}, {}),
    ],
)
def test_what_is_done_to_what_is_brought_is_seen(
    tmp_path: Path, name: str, text: str | None, older: dict[str, str], newer: dict[str, str | None]
) -> None:
    """By the version that brought it, and by the next."""
    write(tmp_path, [OLDER])
    file = put(tmp_path, f"{BROUGHT}/{name}", text or "")
    if text is None:
        file.unlink()
    assert brought(changes(tmp_path, [OLDER])) == older
    expected = {path: why for path, why in {**UPDATED, **newer}.items() if why is not None}
    assert brought(changes(tmp_path, [NEWER])) == expected
    strangers = [f"{BROUGHT}/{name}"] if name == "more.py" else []
    assert survey(tmp_path, [OLDER]).strangers == strangers


def test_versions_that_git_has_joined_are_both_known(tmp_path: Path) -> None:
    write(tmp_path, [OLDER])
    ours = (tmp_path / MANIFEST).read_text(encoding="utf-8")
    write(tmp_path, [NEWER])
    joined = ours + (tmp_path / MANIFEST).read_text(encoding="utf-8")
    put(tmp_path, MANIFEST, joined)
    put(tmp_path, f"{BROUGHT}/changed.py", OLDER.files[f"{BROUGHT}/changed.py"])
    for record in (BOTH, OLDER.files[RECORDED], f"{OLDER.files[RECORDED]}{'0' * 64}  a.py\n"):
        put(tmp_path, RECORDED, record)
        assert brought(changes(tmp_path, [NEWER])).get("changed.py") == "stale"
    write(tmp_path, [NEWER])
    assert changes(tmp_path, [NEWER]) == []


# ------------------------------------------------------------------ several specs in one root


OTHER = output("oven", "spec/oven.yaml", bake="x = 1\n", Bake="bake")
THIRD = output("grill", "spec/grill.yaml", burn="x = 1\n", Burn="burn")


def test_several_specs_lie_side_by_side(tmp_path: Path) -> None:
    write(tmp_path, [BEFORE, OTHER, THIRD, schema()], all_of="spec")
    assert changes(tmp_path, [BEFORE, OTHER, THIRD, schema()]) == []
    # One of them alone changes nothing of the others.
    done = write(tmp_path, [AFTER, schema()])
    folders = {change.path.split("/")[-2] for change in done.changes}
    assert folders <= {"generated", "kiln", "messages", "er", "old"}
    assert changes(tmp_path, [AFTER, OTHER, THIRD, schema()]) == []


@pytest.mark.parametrize("all_of", ["spec", None])
def test_output_under_a_former_name_goes(tmp_path: Path, all_of: str | None) -> None:
    """The library renamed: nothing of the old package is left, and --check says so before."""
    write(tmp_path, [OTHER, BEFORE])
    renamed = output("furnace", SPEC, same="x = 1\n", Heat="heat")
    found = changes(tmp_path, [renamed, OTHER]) if all_of else changes(tmp_path, [renamed])
    assert {c.path for c in found if c.why == "orphaned"} == {MANIFEST, *BEFORE.files}
    write(tmp_path, [renamed, OTHER] if all_of else [renamed], all_of=all_of)
    found_now = snapshot(tmp_path)
    assert found_now == fresh(tmp_path / "elsewhere", OTHER, renamed)


def test_output_of_a_spec_elsewhere_stays(tmp_path: Path) -> None:
    lone = output("oven", "drafts/oven.yaml", bake="x = 1\n")
    write(tmp_path, [BEFORE])
    write(tmp_path, [lone])
    write(tmp_path, [BEFORE], all_of="spec")
    assert changes(tmp_path, [lone]) == []


def test_an_edit_in_the_output_of_a_spec_that_is_gone_is_kept(tmp_path: Path) -> None:
    write(tmp_path, [BEFORE, OTHER])
    put(tmp_path, "generated/oven/bake.py", "mine\n")
    with pytest.raises(Unusable, match=r"edited by hand: generated/oven/bake\.py"):
        write(tmp_path, [BEFORE], all_of="spec")
    write(tmp_path, [BEFORE], all_of="spec", force=True)
    assert (tmp_path / "generated/oven/bake.py.mine").read_bytes() == b"mine\n"
    assert not (tmp_path / "generated/oven.manifest").exists()


def test_a_file_that_moves_to_another_spec_is_no_loss(tmp_path: Path) -> None:
    shared = "generated/shared.py"
    first = replace(BEFORE, files={**BEFORE.files, shared: f"{BANNER}x = 1\n"})
    second = replace(OTHER, files={**OTHER.files, shared: f"{BANNER}x = 2\n"})
    write(tmp_path, [first, OTHER])
    assert whys(write(tmp_path, [BEFORE, second]).changes)[shared] == "stale"
    assert changes(tmp_path, [BEFORE, second]) == []


@pytest.mark.parametrize("name", ["kiln", "Kiln"])
def test_two_specs_of_one_name_are_refused(tmp_path: Path, name: str) -> None:
    twin = output(name, "spec/other.yaml", same="x = 1\n")
    with pytest.raises(Unusable, match=r"spec/kiln\.yaml and spec/other\.yaml both make") as caught:
        write(tmp_path, [BEFORE, twin])
    assert "`name`" in caught.value.hint
    assert snapshot(tmp_path) == {}


def test_two_specs_may_exchange_their_names(tmp_path: Path) -> None:
    for spec in (SPEC, "spec/oven.yaml"):
        put(tmp_path, spec, "")
    exchanged = [
        output("oven", SPEC, same="x = 1\n", Heat="heat"),
        output("kiln", "spec/oven.yaml", bake="x = 1\n", Bake="bake"),
    ]
    write(tmp_path, [BEFORE, OTHER])
    write(tmp_path, exchanged, all_of="spec")
    for spec in (SPEC, "spec/oven.yaml"):
        (tmp_path / spec).unlink()
    (tmp_path / "spec").rmdir()
    found = snapshot(tmp_path)
    assert found == fresh(tmp_path / "elsewhere", *exchanged)


def test_a_spec_does_not_take_over_what_another_has_made(root: Path) -> None:
    put(root, SPEC, "")
    twin = output("kiln", "spec/other.yaml", same="x = 1\n")
    with pytest.raises(Unusable, match=r"generated/kiln\.manifest belongs to spec/kiln\.yaml"):
        write(root, [twin])
    (root / SPEC).unlink()
    write(root, [twin])
    assert changes(root, [twin]) == []


# ------------------------------------------------------------------ a part of the output


def part(whole: Output, folder: str) -> Output:
    """Return the output of one target, which owns that folder."""
    mine = {path: text for path, text in whole.files.items() if path.startswith(f"{folder}/")}
    others = {path: text for path, text in whole.files.items() if path not in mine}
    return replace(whole, files=mine, others=others, folders=(folder,))


def test_a_part_is_written_and_the_rest_is_left(root: Path) -> None:
    before = snapshot(root)
    done = write(root, [part(AFTER, PAGES)])
    pages = (f"{PAGES}/messages/{name}.md" for name in ("Heat", "Fan", "Cool"))
    assert set(whys(done.changes)) == {*pages}
    for path, data in snapshot(root).items():
        assert data == before.get(path) or not path.startswith(f"{LIBRARY}/"), path
    assert changes(root, [part(AFTER, PAGES)]) == []
    # What the rest is, is still known: the whole is written without a word.
    write(root, [AFTER])
    assert changes(root, [AFTER]) == []


def test_a_part_first_and_the_whole_later(tmp_path: Path) -> None:
    write(tmp_path, [part(BEFORE, LIBRARY)])
    write(tmp_path, [AFTER])
    assert snapshot(tmp_path) == fresh(tmp_path / "elsewhere", AFTER)


def test_a_part_without_a_manifest_reports_the_rest(root: Path, tmp_path: Path) -> None:
    (root / MANIFEST).unlink()
    write(root, [part(BEFORE, LIBRARY)])
    write(root, [AFTER])
    assert snapshot(root) == fresh(tmp_path / "elsewhere", AFTER)


# ------------------------------------------------------------------ output of the former layout


def test_output_of_the_former_layout_is_taken_over_in_one_run(tmp_path: Path) -> None:
    mark = "Generated by framegen 0.1.0 from kiln.yaml, 1.0.0; change that, not this."
    put(tmp_path, f"{LIBRARY}/same.py", f"# {mark}\n# SHA-256 of the spec: {'0' * 64}\nx = 1\n")
    put(tmp_path, f"{LIBRARY}/gone.py", f"# {mark}\nx = 1\n")
    put(tmp_path, f"{LIBRARY}/py.typed", "")
    put(tmp_path, f"{LIBRARY}/vectors.json", '{\n  "generated_by": "framegen 0.1.0",\n')
    page = "<!doctype html>\n<html>\n<head>\n<!-- Generated by framegen 0.1.0 from kiln.yaml"
    comment = page.splitlines()[-1]
    put(tmp_path, "docs/reference/index.html", f"{page}, 1.0.0: change that, not this. -->\n")
    put(tmp_path, "docs/reference/messages/Heat.html", f"{page}, 1.0.0: change that. -->\n")
    put(tmp_path, "docs/reference/README.md", f"{comment}: change that, not this. -->")
    put(tmp_path, "docs/reference/other.html", page.replace("kiln", "oven") + ", 1: x -->")
    put(tmp_path, "docs/reference/mine.md", f"How pages are {comment[5:].lower()}\n")
    put(
        tmp_path,
        "spec/framegen.schema.json",
        '{\n  "$schema": "x",\n  "title": "framegen spec",\n}',
    )
    wider = replace(
        BEFORE, files={**BEFORE.files, f"{LIBRARY}/py.typed": "", f"{LIBRARY}/vectors.json": "{}\n"}
    )
    done = write(tmp_path, [wider, schema()])
    assert len(done.notices) == 2
    assert done.kept == {}
    found = snapshot(tmp_path)
    for path in ("docs/reference/other.html", "docs/reference/mine.md"):
        assert found.pop(path) is not None
    assert found == fresh(tmp_path / "elsewhere", wider, schema())


def test_many_files_cost_nothing_where_they_are_in_nobodys_way(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A site is written into a folder of many files without a look at any of them."""
    put(tmp_path, "node_modules/deep/index.js", "")
    put(tmp_path, "docs/reference/index.html", "")
    site = Output("site.manifest", SPEC, {"index.html": "<p>\n"})
    looked_at: list[str] = []
    scan = os.scandir

    def noted(path: Any) -> Any:
        looked_at.append(str(path))
        return scan(path)

    monkeypatch.setattr(os, "scandir", noted)
    write(tmp_path, [site])
    assert [path for path in looked_at if "node_modules" in path or "reference" in path] == []
    assert (tmp_path / "index.html").exists()
