"""The pose methods of the clients as the templates show them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.exchanges import arguments_of
from framegen.targets.python.escape import Bracketed, Part, literal
from framegen.targets.python.method_view import MethodView
from framegen.targets.python.names import signed_name
from framegen.targets.python.spelling import range_expression

if TYPE_CHECKING:
    from framegen.language.spec import Pose
    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Items
    from framegen.targets.python.method_view import Flavour

_RAISED = "NoReplyError if no reply comes in time, and TransportError."


@dataclass(frozen=True, slots=True)
class PoseView:
    """The methods of a client that read and command many positions."""

    pose: Pose
    model: Model
    flavour: Flavour

    @property
    def entry(self) -> str:
        """The description of the pose for the runtime."""
        pose = self.pose
        items: list[str | Bracketed] = [
            f"read={pose.read}",
            f"move={pose.move}",
            f"release={pose.release}",
            f"ids={self._ids}",
        ]
        names = {
            "requested": self.requested,
            "reported": self.reported.name,
            "position": self._position,
            "moved": self._moved.name,
            "time": self.time,
        }
        names["releasing"] = self.model.spec.messages[pose.release].verb or "release"
        items += [f"{key}={literal(name)}" for key, name in names.items()]
        items.append("limits=LIMITS")
        return Bracketed("POSE: Pose = Pose(", items, ")").fitted(0)

    @property
    def read(self) -> str:
        """The message that requests positions."""
        return self.pose.read

    @property
    def requested(self) -> str:
        """The numbers that are requested."""
        [name] = arguments_of(self._message(self.pose.read).message)
        return name

    @property
    def reported(self) -> Items:
        """The list of positions in the reply."""
        found = self._message(self._exchange(self.pose.read).request.message.reply or "").items
        if found is None:
            raise AssertionError("the rule pose sees to that")
        return found

    @property
    def element(self) -> str:
        """The class of one position."""
        return self.reported.element or ""

    @property
    def time(self) -> str:
        """The argument for the duration of a motion."""
        lists = [self._moved.name]
        [name] = [
            each
            for each in arguments_of(self._message(self.pose.move).message)
            if each not in lists
        ]
        return name

    @property
    def move_method(self) -> str:
        """The method that commands positions."""
        return self._exchange(self.pose.move).method.name

    @property
    def moves(self) -> str:
        """The return type of that method."""
        return MethodView(self._exchange(self.pose.move), self.model, self.flavour).returns

    @property
    def call(self) -> str:
        """The expression that sends the request."""
        given = {
            self._moved.name: "targets",
            self.time: self.time,
        }
        arguments = [
            f"{name}={given[name]}" for name in self._exchange(self.pose.move).method.arguments
        ]
        before = f"return {self.flavour.wait}self.{self.move_method}("
        return Bracketed(before, [*arguments], ")").fitted(8)

    @property
    def exchanged(self) -> str:
        """The expression that sends all requests and returns the replies."""
        before = f"exchanged = {self.flavour.wait}self._exchanged("
        return Bracketed(before, [self.pose.read, self.requested], ")").fitted(8)

    @property
    def hold(self) -> str:
        """The declaration of the method that commands the positions that it reads."""
        given = ["self", f"{self.requested}: Iterable[int]", f"{self.time}: int = HOLD_MS"]
        before = f"{self.flavour.define}{self.pose.hold}("
        return Bracketed(before, given, f") -> {self.moves}:").fitted(4)

    @property
    def present(self) -> str:
        """The declaration of the method that finds which ids answer."""
        given = ["self", f"{self.requested}: Iterable[int] | None = None"]
        before = f"{self.flavour.define}{self.pose.present}("
        return Bracketed(before, given, ") -> tuple[int, ...]:").fitted(4)

    @property
    def targets(self) -> str:
        """The declaration of the method that makes targets of positions."""
        positions = Bracketed(f"{self.reported.name}: Iterable[", [self.element], "]", comma="")
        given: list[Part] = ["self", positions]
        return Bracketed(f"def {self.pose.targets}(", given, ") -> list[tuple[int, int]]:").fitted(
            4
        )

    @property
    def limited(self) -> str:
        """The arguments that targets are made from: the positions, and the client's limits."""
        call = "return POSE.targets_of("
        given = [self.reported.name, "self._limits"]
        return Bracketed(call, given, ")").fitted(8).removeprefix(call).removesuffix(")")

    @property
    def hold_doc(self) -> list[str]:
        nearest = (
            "This is the nearest to stopping a motion if the protocol has no message for that: "
            "whatever moves goes back to where it was when it was read, a reply and a command ago."
        )
        given = (
            f"`{self.requested}`: Those to hold; all of them must be present. `{self.time}`: "
            "How long the way back may take, in ms."
        )
        raised = "AbsentError if one is off or missing, LimitError if one is far outside the limits"
        return [
            "Read the current positions, and command them.",
            nearest,
            given,
            f"Returns what `{self.move_method}` does.",
            f"Raises, with nothing sent, {raised}; {_RAISED}",
        ]

    @property
    def present_doc(self) -> list[str]:
        given = (
            f"`{self.requested}`: Those to look for; by default {self.pose.ids}. It takes several "
            "requests if one reply has no room for all."
        )
        return [
            "Return the numbers of those that are present.",
            given,
            f"They are in the order requested. Raises {_RAISED}",
        ]

    @property
    def targets_doc(self) -> list[str]:
        taken = (
            "Those that are absent are left out. For a position a little below zero, or a little "
            "outside the limits of this client, the target is the nearest position inside."
        )
        return [
            "Make targets of positions that were read, to move back to them.",
            taken,
            f"Returns what `{self.move_method}` takes as `{self._moved.name}`.",
            "Raises LimitError for a position that is further out.",
        ]

    @property
    def _ids(self) -> str:
        high = self.pose.ids.high
        return range_expression(range(self.pose.ids.low, (0 if high is None else high) + 1))

    @property
    def _position(self) -> str:
        field = self.reported.fields[1]
        return signed_name(field.name) if field.field.signed_as else field.name

    @property
    def _moved(self) -> Items:
        found = self._message(self.pose.move).items
        if found is None:
            raise AssertionError("the rule pose sees to that")
        return found

    def _message(self, name: str) -> MessageLayout:
        return self.model.messages[name]

    def _exchange(self, name: str) -> Exchange:
        return next(each for each in self.model.exchanges if each.request.name == name)
