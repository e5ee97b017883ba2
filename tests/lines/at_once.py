"""Conversations in real time, held at once: most of each is waiting."""

import traceback
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import Any


def at_once(talk: Callable[..., None], lines: Iterable[tuple[Any, ...]]) -> None:
    """Call `talk` for each of these lines, in threads; fail with all that failed, by line."""

    def failure(line: tuple[Any, ...]) -> str:
        try:
            talk(*line)
        except Exception:  # noqa: BLE001 - it is shown
            return f"{line}: {traceback.format_exc()}"
        return ""

    lines = [*lines]
    with ThreadPoolExecutor(len(lines)) as pool:
        assert "\n".join(filter(None, pool.map(failure, lines))) == ""
