"""The names that Python, its linters or the generated library have taken, by kind of name.

Written out rather than read from the running Python: the same spec gives the same library on every
version. The name of a protocol is none of these: `protocol-name` refuses one that is taken.
"""

from __future__ import annotations

from framegen.language.class_names import (
    AMBIGUOUS_CLASSES,
    DEFAULT_CLIENT,
    LIBRARY_CLASSES,
    PYTHON_CLASSES,
)
from framegen.language.package_names import BUILTINS, KEYWORDS, words
from framegen.model.client_names import ClientNames
from framegen.targets.target import Reserved

# What the clients' own annotations are made of: a method hides no other builtin from anybody.
TYPES = words("bool bytes dict float int list object str tuple type")

# A letter that is taken for a digit.
AMBIGUOUS = words("l")

# What every client has besides the methods of its messages.
CLIENT_ATTRIBUTES = words(
    """
    address at_port broadcast close closed counters device gather on_report reconnect reports
    request send send_latest wait_for
    """
)

# What every message class has or can have, and what every element has, as a tuple among others.
MESSAGE_ATTRIBUTES = words("absent columns decode encode from_dict to_dict")
ELEMENT_ATTRIBUTES = words("absent count index")

# What methods have besides the fields of a message: in their declaration, or as a variable.
ARGUMENTS = words("cls exchanged kind latest replies reply self timeout within")

# What the constructor of a message has as a variable.
CONSTRUCTOR = words("flat")

# What a class of messages or of elements names in its own annotations.
ANNOTATIONS = words("typing")

# The functions of the module of strategies, and what it imports.
STRATEGIES = words("annotations messages noise noisy_streams st")

# What stands beside the names of the ends in recordings and options.
SENDERS = words("any either noise unknown")

# What every message class has besides its named values.
CONSTANTS = words("CONSTANTS DEFAULTS DEPRECATED DIRECTION FRAME IDS LENGTHS SHAPE VENDOR_NAME")
COMMAND = words("COMMAND")

# The classes of fields that a message class names in its body, behind its constants.
FIELD_CLASSES = words("F32 F64 I16 I24 I32 I64 I8 U16 U24 U32 U64 U8")

# The clients of a library whose spec does not name them: in each, those of its own are taken.
CLIENTS = ClientNames(DEFAULT_CLIENT).classes

_KEYWORD = "is a word of Python itself"
_BUILTIN = "would hide what Python has under this name"
_AMBIGUOUS = "is taken for a digit"
_ANNOTATION = "is what types are named by"
_ATTRIBUTE = "is an attribute of every message"
_CLIENT = "is a client of a library whose spec names no other"
_CONSTANT = "is a constant of messages, which hides it there"

RESERVED = (
    Reserved("endpoint", SENDERS, "has a meaning of its own in recordings and options", "_"),
    Reserved("message", PYTHON_CLASSES, "is a class of Python's own", "Message"),
    Reserved("message", LIBRARY_CLASSES, "is a class of every library", "Message"),
    Reserved("message", CLIENTS, _CLIENT, "Message"),
    Reserved("message", AMBIGUOUS_CLASSES, _AMBIGUOUS, "Message"),
    Reserved("element", PYTHON_CLASSES, "is a class of Python's own", "Element"),
    Reserved("element", LIBRARY_CLASSES, "is a class of every library", "Element"),
    Reserved("element", CLIENTS, _CLIENT, "Element"),
    Reserved("element", CONSTANTS | COMMAND, _CONSTANT, "Element"),
    Reserved("element", AMBIGUOUS_CLASSES, _AMBIGUOUS, "Element"),
    Reserved("field", KEYWORDS, _KEYWORD, "_"),
    Reserved("field", BUILTINS, _BUILTIN, "_"),
    Reserved("field", MESSAGE_ATTRIBUTES, _ATTRIBUTE, "_"),
    Reserved("field", ARGUMENTS, "is an argument or a variable of the client's methods", "_"),
    Reserved("field", ANNOTATIONS, _ANNOTATION, "_"),
    Reserved("field", CONSTRUCTOR, "is a variable of the messages' constructors", "_"),
    Reserved("field", AMBIGUOUS, _AMBIGUOUS, "_"),
    Reserved("field of an element", KEYWORDS, _KEYWORD, "_"),
    Reserved("field of an element", BUILTINS, _BUILTIN, "_"),
    Reserved("field of an element", ELEMENT_ATTRIBUTES, "is an attribute of every element", "_"),
    Reserved("field of an element", ANNOTATIONS, _ANNOTATION, "_"),
    Reserved("field of an element", words("cls self"), "is the class or the object itself", "_"),
    Reserved("field of an element", AMBIGUOUS, _AMBIGUOUS, "_"),
    Reserved("method", KEYWORDS, _KEYWORD, "_"),
    Reserved("method", TYPES, _BUILTIN, "_"),
    Reserved("method", CLIENT_ATTRIBUTES, "is an attribute of every client", "_"),
    Reserved("method", AMBIGUOUS, _AMBIGUOUS, "_"),
    Reserved("strategy", KEYWORDS, _KEYWORD, "_"),
    Reserved("strategy", BUILTINS, _BUILTIN, "_"),
    Reserved("strategy", STRATEGIES, "is a function of every library's strategies", "_"),
    Reserved("strategy", AMBIGUOUS, _AMBIGUOUS, "_"),
    Reserved("bits", MESSAGE_ATTRIBUTES, _ATTRIBUTE, "_"),
    Reserved("constant", CONSTANTS, _ATTRIBUTE, "_"),
    Reserved("id", CONSTANTS, _ATTRIBUTE, "_"),
    Reserved("id", FIELD_CLASSES, "is a class of every library", "_"),
)
