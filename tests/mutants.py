"""`make mutants`, second half: whatever mutmut leaves open is tried against whole files of tests.

mutmut runs those tests that entered the changed function while they ran, one by one. What a file
of tests works out while it is imported belongs to none of them, so a survivor may be one in name
only. And where the import fails under a mutant, which is as good a failure as any, pytest cannot
find the requested tests, and mutmut calls it a time-out. Here each of these mutants
meets the files whole, properties included, until something fails.

Run where mutmut has laid out its copy: `cd mutants/mutants && python -m tests.mutants [PATTERN]`.
"""

import json
import os
import re
import resource
import sys
from collections import Counter
from collections.abc import Iterator
from fnmatch import fnmatch
from importlib import import_module
from pathlib import Path

import pytest

HERE = Path(__file__).parent

# The files that judge each package, the innermost of those named here, by folder; and those files
# first that soonest cannot be imported.
JUDGES = {
    "framewire.client": {
        "unit/runtime/client": "session request_states possible_replies client async_client "
        "reports closing motion pose limits gaps acknowledgements local_echo hid_port "
        "doubtful_replies devices conversations",
        "contract/independent": "one_fault",
    },
    "framegen": {
        "unit/model": "verdict layout",
        "unit/runtime/explain": "explain",
        "unit/checks": "bad_specs",
        "unit/reading": "findings scalars",
        "unit/runtime/codec": "edges",
        "unit/language": "values formula",
        "unit/targets": "vectors",
    },
    "busservo": {
        "unit/runtime/codec": "decode edges stream",
        "unit/runtime/frame": "messages narrow_ranges",
        "contract": "oracle",
        "contract/conformance": "answerers",
    },
}
OPTIONS = ("-x", "-q", "--tb=no", "-p", "no:cacheprovider")
QUIET = ("-W", "ignore:Module already imported:pytest.PytestAssertRewriteWarning")

KILLED, NO_END, SURVIVED = "killed", "no end", "survived"
SECONDS = 300
BYTES = 2 << 30


def tried(pattern: str) -> Iterator[tuple[str, str, int]]:
    """Yield the module and name of each mutant that mutmut has tried, and its status."""
    for file in sorted(Path("src").rglob("*.meta")):
        results = json.loads(file.read_text(encoding="utf-8"))["exit_code_by_key"]
        module = file.relative_to("src").as_posix().removesuffix(".py.meta").replace("/", ".")
        for name, result in results.items():
            if result is not None and fnmatch(name, pattern):
                yield module, name, result


def verdict(name: str) -> str:
    """Run whole files of tests in a process of its own, and return the result."""
    child = os.fork()
    if child == 0:
        os._exit(_judge(name))
    _, status = os.waitpid(child, 0)
    code = os.waitstatus_to_exitcode(status)
    # 4: not even tests/conftest.py can be imported.
    return {0: SURVIVED, 1: KILLED, 2: KILLED, 4: KILLED}.get(code, NO_END)


def _judge(name: str) -> int:
    silence = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silence, 1)
    os.dup2(silence, 2)
    used = int(sum(os.times()[:2]))
    resource.setrlimit(resource.RLIMIT_CPU, (used + SECONDS, used + SECONDS))
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    os.environ["MUTANT_UNDER_TEST"] = name
    files = [
        f"tests/{folder}/test_{each}.py"
        for folder, names in JUDGES[package_of(name)].items()
        for each in names.split()
    ]
    return int(pytest.main([*OPTIONS, *QUIET, *left_out(), *files]))


def package_of(name: str) -> str:
    """Return the innermost package of JUDGES that a mutant belongs to."""
    return max((each for each in JUDGES if f"{name}.".startswith(f"{each}.")), key=len)


def left_out() -> list[str]:
    """Return what mutmut leaves out, since its wrappers change what tests look at, or for time."""
    return re.findall(r'"(--deselect=[^"]+)"', Path("pyproject.toml").read_text(encoding="utf-8"))


def main() -> None:
    """Judge the open mutants, and print the status of every mutant, by module."""
    sys.path[:0] = ["src", "."]
    for line in (HERE / "mutation_preload.txt").read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            import_module(line)
    mutants = list(tried(*sys.argv[1:] or ["*"]))
    for package in {package_of(module) for module, _, _ in mutants}:
        # A mutant that there is not: nothing is changed, and nothing may fail.
        if verdict(f"{package}.none") != SURVIVED:
            sys.exit(f"the tests of {package} fail without any mutant")
    found: dict[str, Counter[str]] = {}
    for module, name, result in mutants:
        said = KILLED if result == 1 else verdict(name)
        found.setdefault(module, Counter())[said] += 1
        if said != KILLED:
            print(f"{name}: {said}", flush=True)
    kinds = (KILLED, NO_END, SURVIVED)
    print(f"{'module':34}", *(f"{kind:>9}" for kind in ("mutants", *kinds)))
    for module, counts in found.items():
        numbers = (sum(counts.values()), *(counts[kind] for kind in kinds))
        print(f"{module:34}", *(f"{number:9}" for number in numbers))


if __name__ == "__main__":
    main()
