"""Length rules: read, shown, compared and solved both ways."""

import pytest
from framegen.language.formula import Formula, parse_formula
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn


@in_turn(
    "text, formula",
    lambda: [
        *(("5", Formula(5)), ("0", Formula(0)), ("  7 ", Formula(7)), ("2 + 3", Formula(5))),
        *(("n", Formula(0, 1, "n")), ("n + 3", Formula(3, 1, "n")), ("3 + n", Formula(3, 1, "n"))),
        ("3 * servo_count + 5", Formula(5, 3, "servo_count")),
        *(("servo_count * 3 + 5", Formula(5, 3, "servo_count")), ("3·n+5", Formula(5, 3, "n"))),
        *(("n·3 + 5", Formula(5, 3, "n")), ("5+3*n", Formula(5, 3, "n"))),
        *(("n + n + 1 + 2 * n", Formula(1, 4, "n")), ("2 * n + 1 + 1", Formula(2, 2, "n"))),
        *(("999999", Formula(999999)), ("_n1 + 1", Formula(1, 1, "_n1"))),
    ],
)
def test_a_rule_is_read(text: str, formula: Formula) -> None:
    assert parse_formula(text) == formula


@in_turn(
    "text, said",
    lambda: [
        *((text, "`` is no term") for text in ("", " ", "+", "n +", "+ 5", "n + + 5")),
        *((text, f"`{text}` is no term") for text in ("3 n", "n n", "3 * 4", "n * n", "n * m")),
        *((text, f"`{text}` is no term") for text in ("2 * 3 * n", "n *", "* 3", "n\u00b2")),
        ("1234567", "`123456 7` is no term"),
        ("n ** 2", "`n * * 2` is no term"),
        ("0x10", "`0 x10` is no term"),
        ("n - 3", "`-` has no meaning"),
        ("-3", "`-` has no meaning"),
        ("n / 2", "`/` has no meaning"),
        ("(n + 1)", "`(` has no meaning"),
        ("1.5", "`.` has no meaning"),
        ("n; 3", "`;` has no meaning"),
        ("\u0663 * n", "`\u0663` has no meaning"),
        ("__import__('os')", "`(` has no meaning"),
        ("a + b", "depends on `a` and `b`; one count is the most"),
        ("a + b + c + a", "depends on `a` and `b` and `c`"),
    ],
)
def test_a_malformed_rule_is_reported(text: str, said: str) -> None:
    with pytest.raises(ValueError, match=r"^`|depends") as refused:
        parse_formula(text)
    assert said in str(refused.value)
    if "no term" in said:
        example = "write one like `3 * servo_count + 5`"
        assert str(refused.value) == f"{said} of the length rule `{text}`: {example}"


@in_turn("text", lambda: ["5", "n", "n + 3", "3 * n", "3 * n + 5"])
def test_a_rule_is_shown_as_people_write_it(text: str) -> None:
    assert str(parse_formula(text)) == text


@in_turn(
    "formula, length, count",
    lambda: [
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


@given(FORMULAS, st.integers(0, 300))
def test_a_rule_reads_back_and_is_solved_both_ways(formula: Formula, count: int) -> None:
    assert parse_formula(str(formula)) == formula
    length = formula.at(count)
    assert length == formula.constant + formula.factor * count
    assert formula.count_at(length) == (count if formula.factor else 0)


@given(FORMULAS, st.integers(-5, 2000))
def test_a_length_has_the_first_count_that_gives_it(formula: Formula, length: int) -> None:
    by_search = (each for each in range(2001) if formula.at(each) == length)
    assert formula.count_at(length) == next(by_search, None)


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
            # It refuses zeros in front.
            code = " ".join(w.lstrip("0") or "0" if w.isdigit() else w for w in code.split(" "))
            names = {} if formula.name is None else {formula.name: count}
            known = eval(code, {"__builtins__": {}}, names)  # noqa: S307 - it is a sum
            assert known == formula.at(count)
    assert said.startswith("`")
