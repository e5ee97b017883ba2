"""`make mutants`, first half: mutmut, for all mutants of a pattern or a sample of them.

Run where the code is laid out: `cd mutants && python -m tests.mutate PATTERN [NUMBER [SEED]]`.
mutmut runs mutants by name or pattern, and knows the names once it has made the mutants.
"""

import json
import os
import random
import subprocess
import sys
from fnmatch import fnmatch
from pathlib import Path

MAKE = """
import mutmut.__main__ as mutmut
from pathlib import Path
mutmut.set_mutant_under_test("mutant_generation")
Path("mutants").mkdir(exist_ok=True)
mutmut.copy_src_dir()
mutmut.copy_also_copy_files()
mutmut.setup_source_paths()
mutmut.store_lines_covered_by_tests()
mutmut.create_mutants(1)
"""


def names(pattern: str) -> list[str]:
    """Make the mutants, and return the names that match."""
    subprocess.run([sys.executable, "-c", MAKE], stdout=subprocess.DEVNULL, check=True)
    return sorted(
        name
        for file in Path("mutants", "src").rglob("*.meta")
        for name in json.loads(file.read_text(encoding="utf-8"))["exit_code_by_key"]
        if fnmatch(name, pattern)
    )


def main() -> None:
    """Run mutmut in the place of this process."""
    pattern, *sampled = sys.argv[1:]
    chosen = [pattern]
    if sampled:
        many, seed = int(sampled[0]), int(sampled[1]) if sampled[1:] else 0
        found = names(pattern)
        chosen = random.Random(seed).sample(found, min(many, len(found)))  # noqa: S311
        print(f"{len(chosen)} of {len(found)} mutants, seed {seed}", flush=True)
    mutmut = str(Path(sys.executable).with_name("mutmut"))
    os.execv(mutmut, [mutmut, "run", "--max-children", "1", *chosen])  # noqa: S606


if __name__ == "__main__":
    main()
