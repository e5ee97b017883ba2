"""Length rules: read, shown, compared and solved both ways."""

import pytest
from framegen.language.formula import Formula, parse_formula
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn


@in_turn(
    "text, formula",
    lambda: [
        ("5", Formula(5)),
        ("0", Formula(0)),
        ("  7 ", Formula(7)),
        ("2 + 3", Formula(5)),
        ("n", Formula(0, 1, "n")),
        ("n + 3", Formula(3, 1, "n")),
        ("3 + n", Formula(3, 1, "n")),
        ("3 * servo_count + 5", Formula(5, 3, "servo_count")),
        ("servo_count * 3 + 5", Formula(5, 3, "servo_count")),
        ("3·n+5", Formula(5, 3, "n")),
        ("n·3 + 5", Formula(5, 3, "n")),
        ("5+3*n", Formula(5, 3, "n")),
        ("n + n + 1 + 2 * n", Formula(1, 4, "n")),
        ("2 * n + 1 + 1", Formula(2, 2, "n")),
        ("999999", Formula(999999)),
        ("_n1 + 1", Formula(1, 1, "_n1")),
    ],
)
def test_a_rule_is_read(text: str, formula: Formula) -> None:
    assert parse_formula(text) == formula


@in_turn(
    "text, said",
    lambda: [
        ("", "`` is no term"),
        (" ", "`` is no term"),
        ("+", "`` is no term"),
        ("n +", "`` is no term"),
        ("+ 5", "`` is no term"),
        ("n + + 5", "`` is no term"),
        ("3 n", "`3 n` is no term"),
        ("n n", "`n n` is no term"),
        ("3 * 4", "`3 * 4` is no term"),
        ("n * n", "`n * n` is no term"),
        ("n * m", "`n * m` is no term"),
        ("2 * 3 * n", "`2 * 3 * n` is no term"),
        ("n *", "`n *` is no term"),
        ("* 3", "`* 3` is no term"),
        ("1234567", "`123456 7` is no term"),
        ("n - 3", "`-` has no meaning"),
        ("-3", "`-` has no meaning"),
        ("n / 2", "`/` has no meaning"),
        ("(n + 1)", "`(` has no meaning"),
        ("n ** 2", "`n * * 2` is no term"),
        ("0x10", "`0 x10` is no term"),
        ("1.5", "`.` has no meaning"),
        ("n; 3", "`;` has no meaning"),
        ("n\u00b2", "`n\u00b2` is no term"),
        ("\u0663 * n", "`\u0663` has no meaning"),
        ("a + b", "depends on `a` and `b`; one count is the most"),
        ("a + b + c + a", "depends on `a` and `b` and `c`"),
        ("__import__('os')", "`(` has no meaning"),
    ],
)
def test_a_malformed_rule_is_reported(text: str, said: str) -> None:
    with pytest.raises(ValueError, match=r"^`|depends") as refused:
        parse_formula(text)
    assert said in str(refused.value)


def test_a_malformed_term_is_reported_with_its_rule() -> None:
    with pytest.raises(ValueError, match="no term") as refused:
        parse_formula("3 * n + 2 *")
    assert str(refused.value) == (
        "`2 *` is no term of the length rule `3 * n + 2 *`: write one like `3 * servo_count + 5`"
    )


@pytest.mark.parametrize(
    ("formula", "text"),
    [
        (Formula(5), "5"),
        (Formula(0, 1, "n"), "n"),
        (Formula(3, 1, "n"), "n + 3"),
        (Formula(0, 3, "n"), "3 * n"),
        (Formula(5, 3, "n"), "3 * n + 5"),
    ],
)
def test_a_rule_is_shown_as_people_write_it(formula: Formula, text: str) -> None:
    assert str(formula) == text
    assert parse_formula(text) == formula


@pytest.mark.parametrize(
    ("formula", "length", "count"),
    [
        (Formula(5), 5, 0),
        (Formula(5), 6, None),
        (Formula(5, 3, "n"), 5, 0),
        (Formula(5, 3, "n"), 11, 2),
        (Formula(5, 3, "n"), 12, None),
        (Formula(5, 3, "n"), 2, None),  # as if there were -1 of them
    ],
)
def test_a_length_gives_the_count(formula: Formula, length: int, count: int | None) -> None:
    assert formula.count_at(length) == count


FORMULAS = st.builds(Formula, st.integers(0, 999)) | st.builds(
    Formula, st.integers(0, 999), st.integers(1, 99), st.sampled_from(["n", "servo_count", "_"])
)


@given(FORMULAS)
def test_what_is_shown_reads_back(formula: Formula) -> None:
    assert parse_formula(str(formula)) == formula


@given(FORMULAS, st.integers(0, 300))
def test_a_rule_is_solved_both_ways(formula: Formula, count: int) -> None:
    length = formula.at(count)
    assert length == formula.constant + formula.factor * count
    if formula.factor:
        assert formula.count_at(length) == count
    else:
        assert formula.count_at(length) == 0


@given(FORMULAS, st.integers(-5, 2000))
def test_a_length_that_no_count_gives_has_none(formula: Formula, length: int) -> None:
    count = formula.count_at(length)
    by_search = [each for each in range(2001) if formula.at(each) == length]
    if count is None:
        assert by_search == []
    else:
        assert by_search[0] == count


@given(st.text(alphabet="n3 +*·(-.²x_\n"))
def test_any_text_is_a_rule_or_is_refused_in_words(text: str) -> None:
    try:
        formula = parse_formula(text)
    except ValueError as error:
        said = str(error)
    else:
        said = "`"
        # Python itself reads the same rule in the same way.
        for count in (0, 1, 7):
            code = text.replace("·", "*").replace("\n", " ").strip()
            names = {} if formula.name is None else {formula.name: count}
            known = eval(_decimal(code), {"__builtins__": {}}, names)  # noqa: S307
            assert known == formula.at(count)
    assert said.startswith("`")


def _decimal(code: str) -> str:
    """Return a number without leading zeros, which Python refuses."""
    return " ".join(word.lstrip("0") or "0" if word.isdigit() else word for word in code.split(" "))
