"""Completion, for shells: made by shtab where it is installed, and a hint where it is not."""

from __future__ import annotations

import shutil
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest
from busservo._cli import main
from busservo._cli.examples import VERBS

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.parametrize("shell", ["bash", "zsh", "tcsh", "fish"])
def test_a_shell_learns_the_verbs_their_options_and_the_messages(
    capsys: pytest.CaptureFixture[str], shell: str
) -> None:
    pytest.importorskip("shtab")
    assert main(["--print-completion", shell]) == 0
    script = capsys.readouterr().out
    assert all(verb in script for verb in VERBS)
    assert "retries" in script
    assert "ServoPositionsRead" in script


def completed(script: str, line: str) -> list[str]:
    """Return the words that bash offers for a line whose last word is begun, or empty."""
    words = line.split(" ")
    quoted = " ".join(f"'{word}'" for word in words)
    program = f"""{script}
        COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; COMP_LINE='{line}'
        COMP_POINT=${{#COMP_LINE}}
        _shtab_busservo busservo '{words[-1]}' '{words[-2]}'
        printf '%s\\n' "${{COMPREPLY[@]}}"
    """
    bash = shutil.which("bash")
    assert bash is not None
    done = subprocess.run(
        [bash, "--norc", "-c", program], capture_output=True, text=True, check=True
    )
    return sorted(done.stdout.split())


@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash here")
@pytest.mark.skipif(sys.platform == "win32", reason="bash there is another system's")
def test_bash_completes_verbs_messages_and_options(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("shtab")
    main(["--print-completion", "bash"])
    script = capsys.readouterr().out
    assert completed(script, "busservo mon") == ["monitor"]
    assert completed(script, "busservo send ServoP") == ["ServoPositionsRead"]
    assert completed(script, "busservo encode ServoP") == ["ServoPositions", "ServoPositionsRead"]
    assert completed(script, "busservo monitor --only n") == ["noise"]
    assert completed(script, "busservo monitor --di") == ["--direction"]


def test_without_shtab_there_is_a_hint(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "shtab", None)
    assert main(["--print-completion", "bash"]) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    assert errors == (
        "busservo: error: completion is made by shtab, which is not installed here: "
        "pip install shtab\n"
    )


def test_a_shtab_that_knows_no_fish_is_to_be_renewed(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    shtab = pytest.importorskip("shtab")

    def refuse(*_: object, **__: object) -> None:
        raise NotImplementedError

    monkeypatch.setattr(shtab, "complete", refuse)
    assert main(["--print-completion", "fish"]) == 2
    told = "this shtab is too old to know fish: pip install --upgrade shtab"
    assert capsys.readouterr() == ("", f"busservo: error: {told}\n")


@pytest.mark.skipif(shutil.which("fish") is None, reason="there is no fish here")
def test_fish_completes_verbs_messages_and_options(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    pytest.importorskip("shtab")
    main(["--print-completion", "fish"])
    file = tmp_path / "busservo.fish"
    file.write_text(capsys.readouterr().out, encoding="utf-8")
    fish = shutil.which("fish")
    assert fish is not None
    for line, offered in {
        "busservo mon": {"monitor"},
        "busservo send ServoP": {"ServoPositionsRead"},
        "busservo monitor --di": {"--direction"},
    }.items():
        done = subprocess.run(
            [fish, "--no-config", "-c", f"source {file}; complete -C '{line}'"],
            capture_output=True,
            text=True,
            check=True,
        )
        assert {each.partition("\t")[0] for each in done.stdout.splitlines()} == offered


def test_an_unknown_shell_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--print-completion", "ksh"]) == 2
    assert "invalid choice: 'ksh'" in capsys.readouterr().err
