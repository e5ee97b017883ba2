"""No character that the library shows as it is, is one that ruff takes for another."""

from framegen.targets.python.characters import columns, shown, unbroken


def test_text_of_a_script_is_shown_in_it() -> None:
    text = "Öffnet открыть Ανοίγει 打开阀门。 ノート 열기 5 µm ± 2 °C ≤ 3 Ω"
    assert shown(text) == text


def test_a_wide_character_takes_two_columns_and_may_end_a_line() -> None:
    assert columns("打开 ab") == 7
    assert unbroken("打开ab") == ["打", "开", "ab"]
    # Alone on a line, it would be taken for a slash.
    assert unbroken("漢ノ、字") == ["漢ノ、", "字"]
