"""Names that a spec cannot give, because Python or the generated library has them already.

Written out rather than asked of the running Python: the same spec must get the same answer from
every version.
"""

from __future__ import annotations


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


PYTHON_KEYWORDS = _words(
    """
    False None True and as assert async await break class continue def del elif else except
    finally for from global if import in is lambda nonlocal not or pass raise return try while
    with yield
    """
)

# What an argument or a field of the same name would hide. `type` is a soft keyword, too.
PYTHON_BUILTINS = _words(
    """
    abs aiter all anext any ascii bin bool breakpoint bytearray bytes callable chr classmethod
    compile complex copyright credits delattr dict dir divmod enumerate eval exec exit filter
    float format frozenset getattr globals hasattr hash help hex id input int isinstance
    issubclass iter len license list locals map max memoryview min next object oct open ord pow
    print property quit range repr reversed round set setattr slice sorted staticmethod str sum
    super tuple type vars zip cls self
    """
)

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
LIBRARY_NAMES = _words(
    """
    AbsentError AsyncClient AsyncController AsyncMotion Client ClosedError Column Controller
    Counters decode DecodeError Device Direction DisconnectedError EchoError Element EncodeError
    Exchange EXCHANGES HEADER IncompleteReplyError Items LimitError Limits LIMITS LineCounters
    LineError Message MESSAGES Motion Noise NoReplyError NoReportError Number open_async_controller
    open_controller open_transport PortAddressError PortBusyError PortNotFoundError
    PortPermissionError Pose POSE ProtocolError Reason RECEIVED Rejects Report Run SearchStrategy
    Sent Shape StreamDecoder Table Timed Transport TransportError UNFIT UnknownFrame WriteStuckError
    """
)

# What every client has besides the methods of its messages.
CLIENT_ATTRIBUTES = _words(
    """
    close closed counters on_report reconnect reports request send send_latest wait_for
    """
)

# What every message class has or calls, and what every element has as a tuple.
MESSAGE_ATTRIBUTES = frozenset(["COMMAND", "DIRECTION", "LENGTHS", "columns", "decode", "encode"])
ELEMENT_ATTRIBUTES = frozenset(["count", "index"])
