"""Who follows our pages on a bare machine finds out what does not work there: `.ci/follow.py`."""

import importlib
import os
import re
import shutil
import sys
from pathlib import Path
from types import ModuleType

import pytest

from tests.factories import ROOT, write_files

pytestmark = pytest.mark.skipif(
    os.name == "nt" or shutil.which("bash") is None, reason="there is no bash here"
)


@pytest.fixture(scope="module")
def follow() -> ModuleType:
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(ROOT / ".ci")
        return importlib.import_module("follow")


@pytest.fixture(autouse=True)
def activated(monkeypatch: pytest.MonkeyPatch) -> None:
    programs = Path(sys.executable).parent
    monkeypatch.setenv("PATH", f"{programs}{os.pathsep}{os.environ['PATH']}")


GOOD = """
```sh
cd HERE       # lasts
export ONE=1  # as this does
```

```console
$ echo $ONE; ls design.md
1
design.md
$ seq 3; exit 4
1
...
3
```

```python
# one.py
import os
print(os.environ["ONE"])
```

```output
1
```

```console
$ python one.py
1
```

```pycon
>>> import os
>>> os.environ["ONE"] * 3
'111'
```

```python
import busservo
with busservo.open_controller("COM5") as controller:
    print(controller.read_battery_voltage())
```

```output
7500
```

"""
GOOD += "".join(f"```{kind}\nno such command\n```\n\n" for kind in ("bat", "powershell", "text"))


def test_a_page_that_works_is_followed_to_its_end(follow: ModuleType, tmp_path: Path) -> None:
    write_files({"page.md": GOOD.replace("HERE", str(tmp_path)), "design.md": ""}, tmp_path)
    follow.follow(tmp_path / "page.md", tmp_path / "home")


@pytest.mark.parametrize(
    ("block", "wrong"),
    [
        ("sh\ntrue\nfalse\ntrue", "page.md:2: `false` ends with 1"),
        ("sh\nno-such-command", "no-such-command: command not found"),
        ("console\n$ echo 2\n1", "prints\n2"),
        ("console\n$ echo 1", "prints\n1"),
        ("python\nraise ValueError(1)", "ValueError: 1"),
        ("python\nprint(2)\n```\n\n```output\n1", "prints\n2"),
        ("python\none = 1\n```\n\n```python\nprint(one)", "NameError: name 'one'"),
        ("pycon\n>>> 1 + 1\n3", "Expected:\n    3\nGot:\n    2"),
        ("fish\nset one 1", "nobody knows what to do with `fish`"),
    ],
)
def test_a_page_that_does_not_work_is_found_out(
    follow: ModuleType, block: str, wrong: str, tmp_path: Path
) -> None:
    write_files({"page.md": f"A page.\n```{block}\n```\n"}, tmp_path)
    with pytest.raises(follow.WrongError, match=re.escape(wrong)):
        follow.follow(tmp_path / "page.md", tmp_path / "home")
