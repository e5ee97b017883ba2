"""The command of a library: its library, its verbs, and the texts of its help."""

from __future__ import annotations

from functools import cached_property

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..client.library import Library


class Program:
    """What a generated library hands to its command, and the command to each of its verbs.

    `name` is what is typed, `package` the import name of the library, and `summary` says what it is
    for. `verbs` has the summary of each verb by its name, and `examples` command lines of each with
    what they do. `methods` has the message that a verb sends, and `pose_methods` that of a verb
    that reads or commands positions. `long` has the verb that is meant by a longer name, and
    `stop_message` is what `stop` sends before it holds; empty for nothing.
    """

    def __init__(
        self,
        name: str,
        package: str,
        *,
        summary: str,
        verbs: Mapping[str, str],
        examples: Mapping[str, tuple[tuple[str, str], ...]],
        methods: Mapping[str, str],
        pose_methods: Mapping[str, str],
        long: Mapping[str, str],
        stop_message: str,
    ) -> None:
        self.name = name
        self.package = package
        self.summary = summary
        self.verbs = verbs
        self.examples = examples
        self.methods = methods
        self.pose_methods = pose_methods
        self.long = long
        self.stop_message = stop_message

    def __repr__(self) -> str:
        return f"<the command {self.name} of the library {self.package}>"

    @cached_property
    def library(self) -> Library:
        """The library, which is not imported for those who only look around."""
        # Not importlib, which would have to be imported first.
        library: Library = __import__(f"{self.package}._library", fromlist=["LIBRARY"]).LIBRARY
        return library

    @property
    def port_variable(self) -> str:
        """The environment variable that names the port where no option does."""
        return f"{self.name.upper()}_PORT"

    @property
    def settings_file(self) -> str:
        """The name of the file of settings."""
        return f"{self.name}.toml"

    @property
    def simulator(self) -> str:
        """The package of the simulator, which need not be installed."""
        return f"{self.name}_simulator"
