"""Versions of specs: semantic ones (semver.org), in the part that Python packages know as well."""

from __future__ import annotations

import re
from dataclasses import dataclass

STAGES = ("alpha", "beta", "rc")
# A number of more digits is no version of anything.
_NUMBER = r"(0|[1-9][0-9]{0,8})"
_VERSION = re.compile(rf"{_NUMBER}\.{_NUMBER}\.{_NUMBER}(?:-(alpha|beta|rc)\.{_NUMBER})?")
_SHORT = re.compile(r"[vV]?([0-9]{1,9})(?:\.([0-9]{1,9}))?(?:\.([0-9]{1,9}))?")
# What comes after all that lead up to it.
_FINAL = (len(STAGES), 0)


class NoVersion(ValueError):  # noqa: N818 - says what the text is
    """Text that is no version; `hint` says what to write instead."""

    def __init__(self, text: str, hint: str) -> None:
        super().__init__(f"`{text}` is no semantic version")
        self.hint = hint


@dataclass(frozen=True, slots=True, order=True)
class Version:
    """MAJOR.MINOR.PATCH, or what leads up to it: `2.0.0-rc.1`. Later ones are greater."""

    major: int
    minor: int = 0
    patch: int = 0
    stage: tuple[int, int] = _FINAL

    @classmethod
    def parse(cls, text: str) -> Version:
        """Read a version. Raises NoVersion."""
        found = _VERSION.fullmatch(text)
        if found is None:
            raise NoVersion(text, _remedy(text))
        major, minor, patch = (int(found[at]) for at in (1, 2, 3))
        stage = _FINAL if found[4] is None else (STAGES.index(found[4]), int(found[5]))
        return cls(major, minor, patch, stage)

    @classmethod
    def parse_or_none(cls, text: str) -> Version | None:
        """Read a version; None for what is none."""
        return cls.parse(text) if _VERSION.fullmatch(text) else None

    @property
    def is_final(self) -> bool:
        """Whether it is no alpha, beta or release candidate."""
        return self.stage == _FINAL

    @property
    def final(self) -> Version:
        """The version that this one leads up to, or is."""
        return Version(self.major, self.minor, self.patch)

    def __str__(self) -> str:
        numbers = f"{self.major}.{self.minor}.{self.patch}"
        if self.is_final:
            return numbers
        stage, number = self.stage
        return f"{numbers}-{STAGES[stage]}.{number}"


def _remedy(text: str) -> str:
    short = _SHORT.fullmatch(text.strip())
    if short is not None:
        return f'write "{".".join(str(int(each or 0)) for each in short.groups())}"'
    return 'write three numbers, such as "1.0.0"; only -alpha.1, -beta.1 or -rc.1 may follow'
