"""Programs: what breaks in those that were written for the library of the old edition.

What a program can name is read from the libraries of both editions, as they are generated. What the
names do follows from the two models.
"""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from framegen.comparison.effect import Effect
from framegen.comparison.programs.behaviour import preference_effects, value_effects
from framegen.comparison.programs.exchanges import exchange_effects
from framegen.comparison.programs.folding import folded
from framegen.comparison.programs.libraries import Libraries
from framegen.comparison.programs.library import library_effects
from framegen.comparison.programs.rendered import NoLibrary, rendered
from framegen.comparison.surface import read_surface
from framegen.language.paths import NoPath, read_path
from framegen.model.client_names import client_names

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.pair import Pair
    from framegen.reading.findings import Finding
    from framegen.reading.yamltree import KeyPath


def program_effects(pair: Pair) -> Iterator[Effect]:
    """Yield what programs notice: names that are gone, changed or new, then what names do."""
    yield from folded(_effects(pair))


def _effects(pair: Pair) -> Iterator[Effect]:
    yield from _of_package(pair)
    yield from _of_names(pair)
    yield from _warnings(pair)
    yield from exchange_effects(pair)
    yield from value_effects(pair)
    yield from preference_effects(pair)


def _of_names(pair: Pair) -> Iterator[Effect]:
    """Yield what becomes of names and arguments; that they cannot be compared is uncertain."""
    files: list[dict[str, str]] = []
    for edition in (pair.old, pair.new):
        try:
            files.append(rendered(edition))
        except NoLibrary as error:
            yield _uncompared(error.finding, edition.label, is_old=edition is pair.old)
            return
    old_files, new_files = files
    if old_files != new_files:
        surfaces = read_surface(old_files), read_surface(new_files)
        yield from library_effects(Libraries(pair, *surfaces))


def _warnings(pair: Pair) -> Iterator[Effect]:
    """Yield which messages warn whoever makes them, and which do so no longer."""
    for old, new in pair.messages.to_new.items():
        was = pair.old.model.messages[old].message.deprecated
        now = pair.new.model.messages[new].message.deprecated
        if bool(was) != bool(now):
            text = f"making `{new}` warns now: {now}" if now else f"making `{new}` warns no longer"
            paths = ("messages", old), ("messages", new)
            yield Effect("programs", "deprecated", *paths, text, breaks=False)


def _uncompared(finding: Finding, label: str, *, is_old: bool) -> Effect:
    path: KeyPath = ("protocol",)
    with suppress(NoPath):
        path = read_path(finding.path)
    why = f"no library can be made of {label}, {finding.path}: {finding.message}"
    text = f"names could not be compared: {why}"
    old, new = (path, None) if is_old else (None, path)
    return Effect("programs", "not compared", old, new, text, certain=False)


def _of_package(pair: Pair) -> Iterator[Effect]:
    """Yield what becomes of the library as a whole."""
    specs = pair.old.spec, pair.new.spec
    name = ("protocol", "name")
    old, new = (each.model.spec.protocol.name for each in (pair.old, pair.new))
    if old != new:
        yield Effect("programs", "renamed", name, name, f"`import {old}` is now `import {new}`")
    names = client_names(pair.new.spec)
    client = pair.new.model.roles.client
    if pair.ends.get(pair.old.model.roles.client) != client:
        ends = ("endpoints",)
        was = pair.old.model.roles.client
        text = f"`{names.threads}` is the end of the {client} now; it was that of the {was}"
        yield Effect("programs", "meaning", ends, ends, text)
    boards = [
        {(each.vendor, each.product) for each in spec.link.usb_hid} if spec.link.usb_hid else set()
        for spec in specs
    ]
    for vendor, product in sorted(boards[0] - boards[1]):
        path = ("link", "usb_hid")
        there = path if specs[1].link.usb_hid else None
        text = f"`hid://` does not find {vendor:04x}:{product:04x} any more"
        yield Effect("programs", "removed", path, there, text)
    # What a line is like is a matter of the conversation: a program that names none gets the new.
    for key in ("baud", "local_echo"):
        was, given = getattr(specs[0].link, key), getattr(specs[1].link, key)
        if was != given:
            text = f"`{names.opener}({key}={given})` is the default; it was {was}"
            yield Effect("programs", "value", ("link", key), ("link", key), text, breaks=False)
    if specs[0].pose is not None and specs[1].pose is not None:
        ids = specs[0].pose.ids, specs[1].pose.ids
        if ids[0] != ids[1]:
            path = ("pose", "ids")
            text = f"`{specs[1].pose.present}()` looks for {ids[1]} by default; it did for {ids[0]}"
            yield Effect("programs", "value", path, path, text)
