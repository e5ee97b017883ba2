"""The rules that a spec must keep, one file each, and the functions that check them all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks import (
    absent,
    acknowledged,
    answered_address,
    asks_for,
    breaks,
    chance_prefix,
    checksum,
    client_name,
    constant_field,
    count_bounds,
    counted_by,
    direction,
    duplicate_constant,
    duplicate_id,
    duplicate_name,
    echoed,
    empty_element,
    endpoints,
    erratum,
    example,
    example_origin,
    failure,
    findable_frame,
    floating,
    former_name,
    frame_parts,
    frame_prefix,
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
    list_size,
    long_wait,
    lookalike_example,
    lookalike_frame,
    message_frame,
    message_ids,
    method,
    name_too_long,
    named_bits,
    named_value,
    nested_list,
    newest_first,
    no_example,
    no_message,
    one_frame,
    optional_last,
    packed_list,
    part_name,
    pose,
    protocol_name,
    refusal,
    reply,
    reserved,
    signed_as,
    sized_by,
    text_field,
    twin,
    uncounted,
    unknown_fact,
    unknown_source,
    unknown_type,
    unsent_id,
    unshown_value,
    value_range,
    verb,
    version,
)
from framegen.checks.reading import READING_RULES
from framegen.reading.findings import MOST_FINDINGS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.checks.rule import AnyRule, ModelRule, Problem, StructureRule
    from framegen.language.spec import Spec
    from framegen.model.model import Model
    from framegen.reading.findings import Finding
    from framegen.reading.yamltree import Tree

STRUCTURE_RULES: tuple[StructureRule, ...] = (
    unknown_type.RULE,
    one_frame.RULE,
    frame_parts.RULE,
    checksum.RULE,
    findable_frame.RULE,
    unsent_id.RULE,
    message_frame.RULE,
    message_ids.RULE,
    part_name.RULE,
    endpoints.RULE,
    no_message.RULE,
    identifier.RULE,
    protocol_name.RULE,
    client_name.RULE,
    name_too_long.RULE,
    duplicate_name.RULE,
    former_name.RULE,
    id_range.RULE,
    direction.RULE,
    reserved.RULE,
    counted_by.RULE,
    sized_by.RULE,
    list_size.RULE,
    nested_list.RULE,
    optional_last.RULE,
    constant_field.RULE,
    text_field.RULE,
    packed_list.RULE,
    named_bits.RULE,
    floating.RULE,
    list_last.RULE,
    empty_element.RULE,
    count_bounds.RULE,
    value_range.RULE,
    signed_as.RULE,
    named_value.RULE,
    absent.RULE,
    reply.RULE,
    refusal.RULE,
    failure.RULE,
    echoed.RULE,
    acknowledged.RULE,
    example_origin.RULE,
    unknown_source.RULE,
    version.RULE,
    history.RULE,
    newest_first.RULE,
    breaks.RULE,
    hid_board.RULE,
    lookalike_frame.RULE,
)
# Looked for only where all of the above hold: what follows is known then.
MODEL_RULES: tuple[ModelRule, ...] = (
    duplicate_id.RULE,
    frame_prefix.RULE,
    duplicate_constant.RULE,
    frame_too_long.RULE,
    answered_address.RULE,
    limits.RULE,
    lasts.RULE,
    asks_for.RULE,
    method.RULE,
    verb.RULE,
    pose.RULE,
)
# And these where all of the above hold: what the spec and its documents say of what follows.
EVIDENCE_RULES: tuple[ModelRule, ...] = (
    length_rule.RULE,
    example.RULE,
    no_example.RULE,
    limited_example.RULE,
    unknown_fact.RULE,
    erratum.RULE,
    lookalike_example.RULE,
)
# What may be right as it is, and is worth a look.
REMARKS: tuple[ModelRule, ...] = (
    unshown_value.RULE,
    long_wait.RULE,
    chance_prefix.RULE,
    twin.RULE,
    uncounted.RULE,
)
RULES: tuple[AnyRule, ...] = (
    *READING_RULES,
    *STRUCTURE_RULES,
    *MODEL_RULES,
    *EVIDENCE_RULES,
    *REMARKS,
)


def check_structure(spec: Spec, tree: Tree) -> list[Finding]:
    """Check a spec as it is written; a model can be derived once nothing is found."""
    return _placed(((rule.id, each) for rule in STRUCTURE_RULES for each in rule.look(spec)), tree)


def check_model(model: Model, tree: Tree) -> list[Finding]:
    """Check what follows from a spec; a cause comes before its consequences."""
    for rules in (MODEL_RULES, EVIDENCE_RULES):
        found = _placed(((rule.id, each) for rule in rules for each in rule.look(model)), tree)
        if found:
            return found
    return []


def remarks(model: Model, tree: Tree) -> list[Finding]:
    """Return the remarks on a spec without findings."""
    return _placed(((rule.id, each) for rule in REMARKS for each in rule.look(model)), tree)


def _placed(problems: Iterable[tuple[str, Problem]], tree: Tree) -> list[Finding]:
    """Place the problems in the text, each once, from top to bottom; add hints to those shown."""
    unique = {(each.span(tree), rule, each.message): each for rule, each in problems}
    return [
        unique[key].finding(key[1], tree, hinted=number < MOST_FINDINGS)
        for number, key in enumerate(sorted(unique))
    ]
