"""The `framegen` command, and `python -m framegen`: it says, too, where a package is missing."""

import sys


def main() -> int:
    """Run the command line; the exit code is that of `framegen.cli`."""
    try:
        from framegen.cli import main as run  # noqa: PLC0415 - it may be what cannot be imported

        return run()
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith("framegen"):
            raise
        name = error.name.partition(".")[0]
        sys.stderr.write(
            f"framegen: error: the generator needs `{name}`, which is not installed\n"
            "  hint: in a clone of its repository: pip install . ./codegen\n"
        )
        return 2


if __name__ == "__main__":
    sys.exit(main())
