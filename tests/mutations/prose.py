"""What a spec says in words: where any text may stand, and a spec with one text wherever it may."""

from typing import Any

from tests.factories import Data, Steps
from tests.mutations.places import changed

HARMLESS = "Plain words."
# The keys whose values are prose; endpoints and the commands of look-alikes are prose by place.
PROSE = frozenset(
    [
        *("about", "constructed", "deprecated", "description", "here", "summary", "text", "title"),
        *("changes", "unit", "vendor_name", "what", "why"),
    ]
)


def is_prose(path: Steps) -> bool:
    """Tell whether a text at a place may say anything."""
    words = [step for step in path if isinstance(step, str)]
    return words[-1] in PROSE or words[0] == "endpoints" or "commands" in words


def with_prose(data: Data, text: str) -> Data:
    """Return the spec with `text` wherever prose stands, and for the place of every citation."""

    def change(path: Steps, old: str) -> str:
        if path[-1] == "cite":
            return f"{old.partition(',')[0]}, {text}"
        return text if is_prose(path) else old

    hostile: Data = changed(data, change)
    # Fields that the specs leave without them would hide a place from these tests.
    note = {"text": text, "cite": _cite(hostile, text)}
    for name, end in hostile["endpoints"].items():
        hostile["endpoints"][name] = {"about": text, **(end if isinstance(end, dict) else {})}
    for thing in (hostile["protocol"], *hostile["endpoints"].values(), *_parts(hostile)):
        thing.setdefault("notes", []).append(note)
    for message in hostile["messages"].values():
        message["vendor_name"] = message["deprecated"] = message["description"] = text
        message.setdefault("notes", []).append({"text": text, "cite": _cite(hostile, text)})
        # A field that it names has a unit of time, and no other text.
        message.pop("lasts", None)
        for field in _numbers(message.get("fields", {})):
            field["unit"] = text
            field.setdefault("notes", []).append({"text": text, "cite": _cite(hostile, text)})
    return hostile


def _cite(data: Data, text: str) -> str:
    return f"{data['protocol']['authority']}, {text}"


def _parts(data: Data) -> list[Data]:
    frames = data.get("frames") or {"frame": data["frame"]}
    return [part for frame in frames.values() for part in frame.values()]


def _numbers(fields: dict[str, Any]) -> list[dict[str, Any]]:
    several = (
        (each["fields"].values() if "element" in each else [each]) for each in fields.values()
    )
    return [number for numbers in several for number in numbers]
