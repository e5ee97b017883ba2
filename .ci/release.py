"""Makes a release of what is committed: sets its version, dates its changes, commits and tags.

    python .ci/release.py [--check] VERSION

The version stands in three places, and this is what changes them. With --check, nothing is changed:
it says whether there can be a release. `make release` does that first, then lints and tests.
"""

from __future__ import annotations

import datetime as dt
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PLACES = (
    ("pyproject.toml", r'^version = "(.*)"$'),
    ("codegen/framegen/__init__.py", r'^__version__ = "(.*)"$'),
    ("runtime/framewire/edition.py", r'^VERSION = "(.*)"$'),
)
CHANGES = "CHANGELOG.md"
UNRELEASED = re.compile(r"^## \[Unreleased\]\n(.*?)(?=^## \[|\Z)", re.MULTILINE | re.DOTALL)


class RefusedError(Exception):
    """Why there can be no release, and what to do."""


def git(*words: str) -> str:
    """Return what git prints."""
    done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RefusedError(f"git {words[0]}: {done.stderr.strip()}")
    return done.stdout


def numbers(version: str) -> tuple[int, ...]:
    """Return a version to be compared. Raises RefusedError for what is none."""
    if not re.fullmatch(r"(?:0|[1-9]\d*)(?:\.(?:0|[1-9]\d*)){2}", version, re.ASCII):
        raise RefusedError(
            f"`{version}` is no version: name three numbers, as in make release VERSION=0.2.0"
        )
    return tuple(int(each) for each in version.split("."))


def check(version: str) -> None:
    """See that there can be a release. Raises RefusedError."""
    wanted = numbers(version)
    changed = git("status", "--porcelain")
    if changed:
        raise RefusedError(f"commit or remove this first:\n{changed.rstrip()}")
    if git("tag", "--list", f"v{version}"):
        raise RefusedError(f"there is a v{version} already: take a higher version")
    for place, pattern in PLACES:
        found = re.findall(pattern, (ROOT / place).read_text(encoding="utf-8"), re.MULTILINE)
        if len(found) != 1:
            raise RefusedError(f"{place}: the version stands there {len(found)} times, not once")
        if wanted < numbers(found[0]):
            raise RefusedError(f"{place}: {version} is lower than {found[0]}, which it is now")
    changes = UNRELEASED.search((ROOT / CHANGES).read_text(encoding="utf-8"))
    if changes is None or not changes[1].strip():
        raise RefusedError(f"{CHANGES}: say under `## [Unreleased]` what changes")


def release(version: str) -> None:
    """Set the version, date the changes, commit and tag."""
    for place, pattern in PLACES:
        _replace(place, re.compile(pattern, re.MULTILINE), version)
    today = dt.datetime.now(tz=dt.timezone.utc).date()
    changes = ROOT / CHANGES
    text = changes.read_text(encoding="utf-8")
    title = "## [Unreleased]\n"
    dated = text.replace(title, f"{title}\n## [{version}] - {today}\n", 1)
    changes.write_text(dated, encoding="utf-8", newline="\n")
    git("commit", "--quiet", "--all", "--message", f"Release {version}")
    git("tag", "--annotate", f"v{version}", "--message", f"busservo {version}")


def _replace(place: str, pattern: re.Pattern[str], version: str) -> None:
    file = ROOT / place
    text = file.read_text(encoding="utf-8")
    found = pattern.search(text)
    assert found is not None
    changed = text[: found.start(1)] + version + text[found.end(1) :]
    file.write_text(changed, encoding="utf-8", newline="\n")


def main() -> int:
    """0: done; 2: there can be no release."""
    words = [word for word in sys.argv[1:] if word != "--check"]
    version = words[0] if len(words) == 1 else ""
    try:
        check(version)
        if "--check" not in sys.argv:
            release(version)
            print(f"v{version} is tagged; `git push --follow-tags` shows it to others")
    except RefusedError as error:
        print(f"no release: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
