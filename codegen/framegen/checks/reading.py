"""The rules that are checked while a spec is read, before there is a model."""

from __future__ import annotations

from framegen.checks.rule import ReadingRule

READING_RULES: tuple[ReadingRule, ...] = (
    ReadingRule(
        id="yaml-syntax",
        title="A spec is YAML",
        why="Nothing can be read behind the first syntax error.",
        bad="frame: {header: [",
        good="frame: {header: {is: constant, bytes: AA 55}}",
    ),
    ReadingRule(
        id="yaml-document",
        title="A file holds one spec",
        why="Some programs read what follows a `---`, and others do not.",
        bad="framegen: 2\n---\nframegen: 1",
        good="framegen: 2",
    ),
    ReadingRule(
        id="yaml-duplicate-key",
        title="A key is given once",
        why="Of two values under one key, YAML readers keep either, or refuse the file.",
        bad="{id: 7, id: 8}",
        good="{id: 7}",
    ),
    ReadingRule(
        id="yaml-key",
        title="A key is a word or a number",
        why="Most programs cannot represent a list or a mapping as a key.",
        bad="? [a, b]\n: 1",
        good="a: 1",
    ),
    ReadingRule(
        id="yaml-anchor",
        title="A value is written out, not referred to",
        why="References hide what a line says, and can make a small file a huge one.",
        bad="{a: &x {type: u8}, b: *x}",
        good="{a: {type: u8}, b: {type: u8}}",
    ),
    ReadingRule(
        id="yaml-tag",
        title="A value has no tag",
        why="A tag asks the reader to build something; a spec is data and builds nothing.",
        bad="version: !!str 1.0",
        good='version: "1.0"',
    ),
    ReadingRule(
        id="yaml-ambiguous",
        title="A plain scalar means the same to every YAML reader",
        why="YAML 1.1 and 1.2 read `no`, `010`, `1:30` and `1e3` differently, and editors and "
        "programs use either.",
        bad="title: no",
        good='title: "no"',
    ),
    ReadingRule(
        id="yaml-nesting",
        title="A spec is not nested too deeply",
        why="The language needs few levels; a file with hundreds is meant to break its reader.",
        bad="[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]",
        good="[]",
    ),
    ReadingRule(
        id="invisible-character",
        title="Every character is visible",
        why="A character of no width, or one that turns the direction of text, can make a line say "
        "something else than it shows.",
        bad='title: "Lamp\\u202E"',
        good="title: Lamp",
    ),
    ReadingRule(
        id="edition",
        title="A spec is written in an edition of the language that this framegen reads",
        why="A newer edition may give a key another meaning, so reading it as an older one would "
        "be guessing. Older editions are read for ever.",
        bad="framegen: 3",
        good="framegen: 2",
    ),
    ReadingRule(
        id="many-findings",
        title="The number of findings shown is bounded",
        why="One mistake can cause thousands of findings, all of which go away with it.",
        bad="{aa: 1, ab: 1, ...}  # fifty-one keys that the language does not have",
        good="{}",
    ),
    ReadingRule(
        id="missing-key",
        title="Every required key is given",
        why="Its value cannot be guessed.",
        bad="{id: 7}",
        good="{id: 7, direction: host -> lamp, ...}",
    ),
    ReadingRule(
        id="unknown-key",
        title="Every key is known",
        why="A misspelt key would be ignored together with its value.",
        bad="sumary: Switch the lamp off.",
        good="summary: Switch the lamp off.",
    ),
    ReadingRule(
        id="wrong-value",
        title="Every value has the right type",
        why="A number where text belongs, or a direction that is no direction, has no meaning.",
        bad="direction: host to lamp",
        good="direction: host -> lamp",
    ),
)
