"""The report on an audit as values that JSON has."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from framegen.audit.report import verdict
from framegen.language.values import to_hex

if TYPE_CHECKING:
    from framegen.audit.audit import Audit
    from framegen.audit.conversation import Conversation
    from framegen.audit.coverage import MessageCoverage
    from framegen.audit.evidence import Evidence
    from framegen.audit.misfits import Misfit
    from framegen.audit.values import Values


def as_json(audit: Audit) -> dict[str, Any]:
    """Report to programs."""
    protocol = audit.model.spec.protocol
    return {
        "protocol": protocol.name,
        "version": protocol.version,
        "fits": audit.fits,
        "verdict": verdict(audit),
        "recordings": [{"name": each.name, "bytes": each.size} for each in audit.recordings],
        "bytes": audit.size,
        "messages": audit.seen,
        "either_end": audit.unsure,
        "noise": audit.noise,
        "malformed": audit.malformed,
        "times_backwards": audit.backward,
        "misfits": [_misfit(each) for each in audit.misfits],
        "coverage": {name: _message(each) for name, each in audit.coverage.messages.items()},
        "conversations": {
            name: _conversation(each)
            for name, each in audit.conversations.by_request.items()
            if audit.conversations.has_both_ends
        },
        "questions": [
            {
                "number": each.number,
                "about": each.about,
                "what": each.unknown.what,
                "seen": each.seen,
            }
            for each in audit.questions
        ],
        "raised": [
            {
                "message": each.message.name,
                "facts": [fact.place for fact in each.facts],
                "yaml": each.yaml,
            }
            for each in audit.raised
        ],
        "evidence": evidence_json(audit.evidence),
    }


def evidence_json(known: Evidence) -> dict[str, Any]:
    """Return what a spec is known from."""
    return {
        "protocol": known.name,
        "version": known.version,
        "messages": known.messages,
        "facts": len(known.facts),
        "seen_on_hardware": known.seen,
        "by_kind": known.by_kind,
        "questions": known.questions,
    }


def _misfit(misfit: Misfit) -> dict[str, Any]:
    return {
        "kind": misfit.kind,
        "what": misfit.what,
        "why": misfit.why,
        "times": misfit.times,
        "bytes": misfit.size,
        "examples": [{"place": place, "hex": to_hex(data)} for place, data in misfit.examples],
    }


def _message(covered: MessageCoverage) -> dict[str, Any]:
    return {
        "seen": covered.seen,
        "either_end": covered.unsure,
        "sizes": sorted(covered.sizes),
        "fields": {path: _values(each) for path, each in covered.values.items()},
        "examples_never_seen": [each.title for each in covered.unseen_examples],
    }


def _values(values: Values) -> dict[str, Any]:
    return {
        "seen": values.seen,
        "different": len(values.counts),
        "lowest": _finite(values.lowest),
        "highest": _finite(values.highest),
        "low_seen": values.has_low,
        "high_seen": values.has_high,
        "named_seen": values.named_seen,
        "unnamed": {str(value): count for value, count in values.unnamed.items()},
        "beyond_limits": {str(value): count for value, count in values.beyond_limits.items()},
        "unknown_bits": values.unknown_bits,
    }


def _conversation(found: Conversation) -> dict[str, Any]:
    times = found.seconds
    return {
        "requests": found.requests,
        "answered": found.answered,
        "refused": found.refused,
        "failed": found.failed,
        "to_silent_addresses": found.silent,
        "unanswered": found.unanswered,
        "unsolicited": found.unsolicited,
        "seconds": {"least": min(times), "median": found.median, "most": max(times)}
        if times
        else None,
    }


def _finite(value: Any) -> Any:
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value
