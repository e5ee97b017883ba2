"""The rules that a spec must keep, one file each, and `check`, which looks for all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks import (
    absent,
    acknowledged,
    count_bounds,
    counted_by,
    direction,
    duplicate_constant,
    duplicate_id,
    duplicate_name,
    echoed,
    empty_group,
    erratum,
    example,
    example_origin,
    frame_parts,
    frame_too_long,
    hid_board,
    history,
    id_range,
    identifier,
    lasts,
    length_rule,
    limited_example,
    limits,
    list_last,
    lookalike_example,
    lookalike_frame,
    method,
    named_value,
    no_example,
    no_message,
    pose,
    reply,
    reserved,
    signed_as,
    unknown_fact,
    unknown_source,
    unknown_type,
    unshown_value,
    value_range,
)
from framegen.checks.reading import READING_RULES
from framegen.model.layout import derive
from framegen.reading.findings import in_order

if TYPE_CHECKING:
    from framegen.checks.rule import LayoutRule, StructureRule
    from framegen.language.load import Loaded
    from framegen.reading.findings import Finding

STRUCTURE_RULES: tuple[StructureRule, ...] = (
    unknown_type.RULE,
    frame_parts.RULE,
    no_message.RULE,
    identifier.RULE,
    duplicate_name.RULE,
    duplicate_constant.RULE,
    duplicate_id.RULE,
    id_range.RULE,
    direction.RULE,
    reserved.RULE,
    counted_by.RULE,
    list_last.RULE,
    empty_group.RULE,
    count_bounds.RULE,
    frame_too_long.RULE,
    value_range.RULE,
    limits.RULE,
    signed_as.RULE,
    named_value.RULE,
    absent.RULE,
    reply.RULE,
    echoed.RULE,
    acknowledged.RULE,
    lasts.RULE,
    method.RULE,
    pose.RULE,
    example_origin.RULE,
    unknown_source.RULE,
    history.RULE,
    hid_board.RULE,
    lookalike_frame.RULE,
)
LAYOUT_RULES: tuple[LayoutRule, ...] = (
    length_rule.RULE,
    example.RULE,
    no_example.RULE,
    unshown_value.RULE,
    limited_example.RULE,
    unknown_fact.RULE,
    erratum.RULE,
    lookalike_example.RULE,
)

__all__ = ["LAYOUT_RULES", "READING_RULES", "STRUCTURE_RULES", "check"]


def check(loaded: Loaded) -> list[Finding]:
    """Say everything that can be said against a spec, from the top of the file down."""
    findings = list(loaded.findings)
    spec = loaded.spec
    if spec is not None:
        structure = [
            problem.finding(rule.id, loaded.tree)
            for rule in STRUCTURE_RULES
            for problem in rule.look(spec)
        ]
        findings += structure
        if not structure:
            layout = derive(spec)
            findings += [
                problem.finding(rule.id, loaded.tree)
                for rule in LAYOUT_RULES
                for problem in rule.look(layout)
            ]
    return in_order(findings)
