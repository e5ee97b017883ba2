"""A target for a language that nobody speaks: a message a line. All that a target has to be."""

from framegen.compile import Compiled
from framegen.language.spec import Example
from framegen.model.layout import MessageLayout
from framegen.model.model import Model
from framegen.targets.target import BentName, Comment, Reserved, Snippet, Snippets, Target

WORDS = Reserved("message", frozenset(["VentsOpen", "Halt"]), "is a word of the language", "_")


def render(compiled: Compiled, _snippets: Snippets) -> dict[str, str]:
    """Return a list of the messages, and a file of data, which has no comments."""
    (folder,) = folders(compiled.model)
    lines = [f"{_name(each.name)} {each.id}\n" for each in compiled.model.messages.values()]
    return {f"{folder}/messages.toy": "".join(lines), f"{folder}/count.dat": f"{len(lines)}\n"}


def folders(model: Model) -> tuple[str, ...]:
    return (f"generated/{model.spec.protocol.name}_toy",)


def bent(model: Model) -> list[BentName]:
    return [
        BentName(("messages", name), WORDS.kind, name, _name(name), WORDS.why)
        for name in model.messages
        if name != _name(name)
    ]


def snippets(_model: Model, message: MessageLayout, _example: Example) -> list[Snippet]:
    return [Snippet("Say it", "toy", f"say {_name(message.name)}\n")]


def _name(name: str) -> str:
    return f"{name}{WORDS.suffix}" if name in WORDS.words else name


TARGET = Target(
    name="toy",
    about="A message a line.",
    render=render,
    folders=folders,
    comments={".toy": Comment("(* ", " *)")},
    reserved=(WORDS,),
    bent=bent,
    snippets=snippets,
)
