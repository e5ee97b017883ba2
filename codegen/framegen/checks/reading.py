"""The rules that a spec keeps or breaks while it is read, before there is anything to look at."""

from __future__ import annotations

from framegen.checks.rule import ReadingRule

READING_RULES: tuple[ReadingRule, ...] = (
    ReadingRule(
        id="yaml-syntax",
        title="A spec is YAML",
        why="Nothing can be read beyond the place where it is not.",
        bad="frame: {header: [",
        good="frame: {header: {is: constant, bytes: AA 55}}",
    ),
    ReadingRule(
        id="yaml-document",
        title="A file holds one spec",
        why="What stands after a `---` would be read by some programs and not by others.",
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
        why="A list or a mapping as a key is YAML that most programs cannot hold.",
        bad="? [a, b]\n: 1",
        good="a: 1",
    ),
    ReadingRule(
        id="yaml-anchor",
        title="A value stands where it is meant",
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
        title="A plain value means the same to every YAML reader",
        why="YAML 1.1 and 1.2 read `no`, `010`, `1:30` and `1.0` differently, and editors and "
        "programs use either.",
        bad="version: 1.0",
        good='version: "1.0"',
    ),
    ReadingRule(
        id="yaml-nesting",
        title="A spec is not nested without end",
        why="The language needs few levels; a file with hundreds is meant to break its reader.",
        bad="[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]",
        good="[]",
    ),
    ReadingRule(
        id="invisible-character",
        title="A reader sees every character",
        why="A character of no width, or one that turns the direction of text, can make a line say "
        "something else than it shows.",
        bad='title: "Lamp\\u202E"',
        good="title: Lamp",
    ),
    ReadingRule(
        id="edition",
        title="A spec is written in an edition of the language that this framegen reads",
        why="A newer edition gives a key another meaning, and to read it as an older one is to "
        "guess. Older ones are read for ever.",
        bad="framegen: 3",
        good="framegen: 2",
    ),
    ReadingRule(
        id="many-findings",
        title="As many findings are shown as can be mended in one go",
        why="One slip can make thousands of them, all of which are gone once it is mended.",
        bad="{aa: 1, ab: 1, ...}  # fifty-one keys that the language does not have",
        good="{}",
    ),
    ReadingRule(
        id="missing-key",
        title="Every key that is needed is there",
        why="What it would say cannot be guessed.",
        bad="{id: 7}",
        good="{id: 7, direction: host -> lamp, ...}",
    ),
    ReadingRule(
        id="unknown-key",
        title="Every key is one that the language has",
        why="A misspelt key would be passed over, and what it says with it.",
        bad="sumary: Switch the lamp off.",
        good="summary: Switch the lamp off.",
    ),
    ReadingRule(
        id="wrong-value",
        title="Every value is of its kind",
        why="A number where text belongs, or a direction that is no direction, has no meaning.",
        bad="direction: host to lamp",
        good="direction: host -> lamp",
    ),
)
