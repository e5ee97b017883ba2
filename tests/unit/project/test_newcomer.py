"""Who follows our pages on a bare machine finds out what does not work there: `.ci/follow.py`."""

import importlib.util
import os
import shutil
import sys
from pathlib import Path
from types import ModuleType

import pytest

from tests.documents import ROOT

pytestmark = pytest.mark.skipif(
    os.name == "nt" or shutil.which("bash") is None, reason="there is no bash here"
)


@pytest.fixture(scope="module")
def follow() -> ModuleType:
    found = importlib.util.spec_from_file_location("follow", ROOT / ".ci" / "follow.py")
    assert found is not None
    assert found.loader is not None
    module = importlib.util.module_from_spec(found)
    sys.modules["follow"] = module
    found.loader.exec_module(module)
    return module


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

```bat
no such command
```

```powershell
no such command
```

```text
no such command
```
"""


def test_a_page_that_works_is_followed_to_its_end(follow: ModuleType, tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    (tmp_path / "design.md").touch()
    page.write_text(GOOD.replace("HERE", str(tmp_path)), encoding="utf-8")
    follow.follow(page, tmp_path / "home")


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
    page = tmp_path / "page.md"
    page.write_text(f"A page.\n```{block}\n```\n", encoding="utf-8")
    with pytest.raises(follow.WrongError) as caught:
        follow.follow(page, tmp_path / "home")
    assert wrong in str(caught.value)
