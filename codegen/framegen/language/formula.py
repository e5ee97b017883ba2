"""Length rules: `3 * servo_count + 5`, linear in one count, read, compared and solved both ways."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TypeAlias

_TOKEN = re.compile(r"\s*(?:(?P<number>[0-9]{1,6})|(?P<name>[A-Za-z_]\w*)|(?P<sign>[*+·]))")


@dataclass(frozen=True, slots=True)
class Formula:
    """`factor * name + constant`; a fixed length has no name and the factor 0."""

    constant: int
    factor: int = 0
    name: str | None = None

    def __str__(self) -> str:
        if self.name is None:
            return str(self.constant)
        term = self.name if self.factor == 1 else f"{self.factor} * {self.name}"
        return f"{term} + {self.constant}" if self.constant else term

    def at(self, count: int) -> int:
        """Return the length of a frame with `count` elements."""
        return self.factor * count + self.constant

    def count_at(self, length: int) -> int | None:
        """Return the count that gives `length`, or None where no count does."""
        if self.factor == 0:
            return 0 if length == self.constant else None
        count, rest = divmod(length - self.constant, self.factor)
        return count if rest == 0 and count >= 0 else None


@dataclass(frozen=True, slots=True)
class Sizes:
    """The lengths of a message whose last fields may be absent: `[2, 4]`, the shortest first."""

    sizes: tuple[int, ...]

    # As a formula has them: it depends on no count that a frame holds.
    name = None
    factor = 0

    @property
    def constant(self) -> int:
        """The shortest length."""
        return self.sizes[0]

    def __str__(self) -> str:
        return ", ".join(map(str, self.sizes))

    def at(self, count: int) -> int:
        """Return the length of a frame with `count` of the optional fields."""
        return self.sizes[count]

    def count_at(self, length: int) -> int | None:
        """Return the number of optional fields at `length`, or None where no number gives it."""
        return self.sizes.index(length) if length in self.sizes else None


LengthRule: TypeAlias = Formula | Sizes


def sizes_of(lengths: list[object]) -> Sizes:
    """Read a list of lengths. Raises ValueError that says what is wrong."""
    for length in lengths:
        if not isinstance(length, int) or isinstance(length, bool) or length < 0:
            raise ValueError(f"`{length}` is no length: list whole numbers, like `[2, 4]`")
    sizes = tuple(each for each in lengths if isinstance(each, int))
    if not sizes or sorted(set(sizes)) != list(sizes):
        raise ValueError("the lengths are listed once each, the shortest first, like `[2, 4]`")
    return Sizes(sizes)


def parse_formula(text: str) -> Formula:
    """Read a length rule. Raises ValueError that says what is wrong."""
    terms = _terms(_tokens(text), text)
    constant = sum(factor for factor, name in terms if name is None)
    names = list(dict.fromkeys(name for _, name in terms if name is not None))
    if len(names) > 1:
        raise ValueError(
            f"`{text}` depends on {' and '.join(f'`{n}`' for n in names)}; one count is the most"
        )
    if not names:
        return Formula(constant)
    return Formula(constant, sum(factor for factor, name in terms if name is not None), names[0])


def _tokens(text: str) -> list[str]:
    tokens: list[str] = []
    at, end = 0, len(text.rstrip())
    while at < end:
        match = _TOKEN.match(text, at)
        if match is None:
            raise ValueError(
                f"`{text[at:].strip()[:1]}` has no meaning in the length rule `{text}`"
            )
        tokens.append(match.group().strip())
        at = match.end()
    return tokens


def _terms(tokens: list[str], text: str) -> list[tuple[int, str | None]]:
    """Split at `+`; a term is a number, a name, or the product of the two."""
    terms: list[tuple[int, str | None]] = []
    term: list[str] = []
    for piece in [*tokens, "+"]:
        if piece != "+":
            term.append(piece)
            continue
        terms.append(_term(term, text))
        term = []
    return terms


def _term(term: list[str], text: str) -> tuple[int, str | None]:
    match term:
        case [number] if number.isdigit():
            return int(number), None
        case [name] if name.isidentifier():
            return 1, name
        case [number, "*" | "·", name] if number.isdigit() and name.isidentifier():
            return int(number), name
        case [name, "*" | "·", number] if number.isdigit() and name.isidentifier():
            return int(number), name
    raise ValueError(
        f"`{' '.join(term)}` is no term of the length rule `{text}`: "
        "write one like `3 * servo_count + 5`"
    )
