"""The names that Python, its linters or the generated library have taken, by kind of name.

Written out rather than read from the running Python: the same spec gives the same library on every
version. Modules are those of Python 3.10 to 3.13 on all systems, keywords and builtins likewise.
"""

from __future__ import annotations

from framegen.targets.filenames import DEVICES
from framegen.targets.target import Reserved


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


# The last line are soft keywords.
KEYWORDS = _words(
    """
    and as assert async await break class continue def del elif else except
    finally for from global if import in is lambda nonlocal not or pass raise return try while
    with yield
    case match type
    """
)

# What an argument or a property of the same name would hide.
BUILTINS = _words(
    """
    abs aiter all anext any ascii bin bool breakpoint bytearray bytes callable chr classmethod
    compile complex copyright credits delattr dict dir divmod enumerate eval exec exit filter
    float format frozenset getattr globals hasattr hash help hex id input int isinstance
    issubclass iter len license list locals map max memoryview min next object oct open ord pow
    print property quit range repr reversed round set setattr slice sorted staticmethod str sum
    super tuple vars zip
    """
)

# What the clients' own annotations are made of: a method hides no other builtin from anybody.
TYPES = _words("bool bytes dict float int list object str tuple type")

# Letters that are taken for digits.
AMBIGUOUS_CLASSES = _words("I O")
AMBIGUOUS = _words("l")

# Classes that Python has without an import, or that generated modules import.
PYTHON_CLASSES = _words(
    """
    False None True ArithmeticError AssertionError AttributeError BaseException BaseExceptionGroup
    BlockingIOError BrokenPipeError BufferError BytesWarning ChildProcessError
    ConnectionAbortedError ConnectionError ConnectionRefusedError ConnectionResetError
    DeprecationWarning EOFError Ellipsis EncodingWarning EnvironmentError Exception
    ExceptionGroup FileExistsError FileNotFoundError FloatingPointError FutureWarning
    GeneratorExit IOError ImportError ImportWarning IndentationError IndexError InterruptedError
    IsADirectoryError KeyError KeyboardInterrupt LookupError MemoryError ModuleNotFoundError
    NameError NotADirectoryError NotImplemented NotImplementedError OSError OverflowError
    PendingDeprecationWarning PermissionError ProcessLookupError PythonFinalizationError
    RecursionError ReferenceError ResourceWarning RuntimeError RuntimeWarning StopAsyncIteration
    StopIteration SyntaxError SyntaxWarning SystemError SystemExit TabError TimeoutError
    TypeError UnboundLocalError UnicodeDecodeError UnicodeEncodeError UnicodeError
    UnicodeTranslateError UnicodeWarning UserWarning ValueError Warning WindowsError
    ZeroDivisionError Any Callable ClassVar Enum Final Iterable Iterator Literal Mapping
    NamedTuple Protocol Self Sequence Struct StructError SupportsIndex TypeAlias TypeVar Union
    """
)

# What the library exports or is built of, whatever the protocol.
LIBRARY_CLASSES = _words(
    """
    AbsentError Address AllDevices Always AsyncAllDevices AsyncClient AsyncController AsyncMotion
    AsyncOneDevice Client ClosedError Column Controller Counters Decoded DecodeError Device
    Direction DisconnectedError DoubtfulReplyError EchoError Element EncodeError Event Exchange
    EXCHANGES F32 F64 FailureError Failures Field HEADER I16 I24 I32 I64 I8 IncompleteReplyError
    Items Kind LimitError LIMITS Limits LineCounters LineError List Message MESSAGES MixedElement
    Motion Noise NoReplyError NoReportError Number OneDevice Optional Packed PortAddressError
    PortBusyError PortNotFoundError PortPermissionError POSE Pose ProtocolError Reason RECEIVED
    RefusedError Rejects Report Reserved Run SearchStrategy Sent Shape StreamDecoder SwappedF32
    SwappedF64 SwappedI16 SwappedI24 SwappedI32 SwappedI64 SwappedU16 SwappedU24 SwappedU32
    SwappedU64 Table Text Timed Transport TransportError U16 U24 U32 U64 U8 UNFIT UnknownFrame
    WriteStuckError
    """
)

# What every client has besides the methods of its messages.
CLIENT_ATTRIBUTES = _words(
    """
    address broadcast close closed counters device gather on_report reconnect reports request send
    send_latest wait_for
    """
)

# What every message class has or can have, and what every element has, as a tuple among others.
MESSAGE_ATTRIBUTES = _words("absent columns decode encode from_dict to_dict")
ELEMENT_ATTRIBUTES = _words("absent count index")

# What methods have besides the fields of a message: in their declaration, or as a variable.
ARGUMENTS = _words("cls exchanged kind latest replies reply self timeout within")

# What the constructor of a message has as a variable.
CONSTRUCTOR = _words("flat")

# The functions of the module of strategies, and what it imports.
STRATEGIES = _words("annotations messages noise noisy_streams st")

# What stands beside the names of the ends in recordings and options.
SENDERS = _words("any either noise unknown")

# What every message class has besides its named values.
CONSTANTS = _words("CONSTANTS DEFAULTS DEPRECATED DIRECTION FRAME IDS LENGTHS SHAPE VENDOR_NAME")
COMMAND = _words("COMMAND")

# The classes of fields that a message class names in its body, behind its constants.
FIELD_CLASSES = _words("F32 F64 I16 I24 I32 I64 I8 U16 U24 U32 U64 U8")

MODULES = _words(
    """
    abc aifc antigravity argparse array ast asynchat asyncio asyncore atexit audioop base64 bdb
    binascii binhex bisect builtins bz2 calendar cgi cgitb chunk cmath cmd code codecs
    codeop collections colorsys compileall concurrent configparser contextlib contextvars copy
    copyreg crypt csv ctypes curses dataclasses datetime dbm decimal difflib dis distutils
    doctest email encodings ensurepip enum errno faulthandler fcntl filecmp fileinput fnmatch
    fractions ftplib functools gc genericpath getopt getpass gettext glob graphlib grp gzip
    hashlib heapq hmac html http idlelib imaplib imghdr imp importlib inspect io ipaddress
    itertools json keyword lib2to3 linecache locale logging lzma mailbox mailcap marshal math
    mimetypes mmap modulefinder msilib msvcrt multiprocessing netrc nis nntplib nt ntpath
    nturl2path numbers opcode operator optparse os ossaudiodev pathlib pdb pickle pickletools
    pipes pkgutil platform plistlib poplib posix posixpath pprint profile pstats pty pwd
    py_compile pyclbr pydoc pydoc_data pyexpat queue quopri random re readline reprlib resource
    rlcompleter runpy sched secrets select selectors shelve shlex shutil signal site smtpd
    smtplib sndhdr socket socketserver spwd sqlite3 sre_compile sre_constants sre_parse ssl stat
    statistics string stringprep struct subprocess sunau symtable sys sysconfig syslog tabnanny
    tarfile telnetlib tempfile termios test textwrap this threading time timeit tkinter token
    tokenize tomllib trace traceback tracemalloc tty turtle turtledemo types typing unicodedata
    unittest urllib uu uuid venv warnings wave weakref webbrowser winreg winsound wsgiref xdrlib
    xml xmlrpc zipapp zipfile zipimport zlib zoneinfo
    """
)

# What the library or its users import besides, and what makes it.
PACKAGES = _words(
    "framegen hid hypothesis jinja2 pydantic pytest serial shtab typing_extensions yaml"
)

_KEYWORD = "is a word of Python itself"
_BUILTIN = "would hide what Python has under this name"
_AMBIGUOUS = "is taken for a digit"
_ATTRIBUTE = "is an attribute of every message"
_CONSTANT = "is a constant of messages, which hides it there"

RESERVED = (
    Reserved("package", KEYWORDS, _KEYWORD, "_protocol"),
    Reserved("package", BUILTINS, _BUILTIN, "_protocol"),
    Reserved("package", MODULES, "is a module of Python's standard library", "_protocol"),
    Reserved("package", PACKAGES, "is a package that is used beside the library", "_protocol"),
    Reserved("package", DEVICES, "is a device on Windows, and no folder there", "_protocol"),
    Reserved("endpoint", SENDERS, "has a meaning of its own in recordings and options", "_"),
    Reserved("message", PYTHON_CLASSES, "is a class of Python's own", "Message"),
    Reserved("message", LIBRARY_CLASSES, "is a class of every library", "Message"),
    Reserved("message", AMBIGUOUS_CLASSES, _AMBIGUOUS, "Message"),
    Reserved("element", PYTHON_CLASSES, "is a class of Python's own", "Element"),
    Reserved("element", LIBRARY_CLASSES, "is a class of every library", "Element"),
    Reserved("element", CONSTANTS | COMMAND, _CONSTANT, "Element"),
    Reserved("element", AMBIGUOUS_CLASSES, _AMBIGUOUS, "Element"),
    Reserved("field", KEYWORDS, _KEYWORD, "_"),
    Reserved("field", BUILTINS, _BUILTIN, "_"),
    Reserved("field", MESSAGE_ATTRIBUTES, _ATTRIBUTE, "_"),
    Reserved("field", ARGUMENTS, "is an argument or a variable of the client's methods", "_"),
    Reserved("field", CONSTRUCTOR, "is a variable of the messages' constructors", "_"),
    Reserved("field", AMBIGUOUS, _AMBIGUOUS, "_"),
    Reserved("field of an element", KEYWORDS, _KEYWORD, "_"),
    Reserved("field of an element", BUILTINS, _BUILTIN, "_"),
    Reserved("field of an element", ELEMENT_ATTRIBUTES, "is an attribute of every element", "_"),
    Reserved("field of an element", _words("cls self"), "is the class or the object itself", "_"),
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
