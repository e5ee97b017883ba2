"""The version of this, and the contract between it and libraries that are generated, as a number.

The number goes up when a library could not work with the runtime of before, or the runtime not with
such a library: when what one hands to the other changes.
"""

VERSION = "0.1.0"
"""The version of the release that this is from."""
EDITION = 1
"""What libraries are generated for today."""
OLDEST = 1
"""The oldest that this still serves."""
# As others import it: a library that carries it knows no `framewire`.
_NAME = __name__.rpartition(".")[0]


def refuse_others(edition: int, library: str) -> None:
    """Raise ImportError for a library of an edition that this does not serve."""
    if edition > EDITION:
        raise ImportError(
            f"{library} was generated for edition {edition} of {_NAME}, and this is {EDITION}: "
            f"install a newer version of what brings {_NAME}"
        )
    if edition < OLDEST:
        raise ImportError(
            f"{library} was generated for edition {edition} of {_NAME}, and this serves "
            f"{OLDEST} to {EDITION}: generate it again, with the framegen of this {_NAME}"
        )
