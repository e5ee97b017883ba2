"""The classes that Python, its linters or every library have, whatever a spec says."""

from __future__ import annotations

from framegen.language.package_names import words

# What the client is called where a spec does not say.
DEFAULT_CLIENT = "Controller"

# Letters that are taken for digits.
AMBIGUOUS_CLASSES = words("I O")

# Classes that Python has without an import, or that generated modules import.
PYTHON_CLASSES = words(
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
    NamedTuple PathLike Protocol Self Sequence Struct StructError SupportsIndex TypeAlias TypeVar
    Union
    """
)

# What the library exports or is built of, whatever the protocol.
LIBRARY_CLASSES = words(
    """
    AbsentError Address AllDevices Allowed Always AsyncAllDevices AsyncClient AsyncMotion
    AsyncOneDevice Client ClosedError CODEC Column Counters Decoded DecodeError Device Direction
    DisconnectedError DoubtfulReplyError EchoError Element EncodeError Event Exchange EXCHANGES F32
    F64 FailureError Failures Field HEADS I16 I24 I32 I64 I8 IncompleteReplyError Items Kind LIBRARY
    LimitError LIMITS Limits LineCounters LineError LINK List Message MESSAGES MixedElement Motion
    Noise NoReplyError NoReportError NotHeldError Number OneDevice Optional Packed PortAddressError
    PortBusyError PortNotFoundError PortPermissionError POSE Pose ProtocolError Reason RECEIVED
    RefusedError Rejects Report Reserved Run SearchStrategy Sent Shape StreamDecoder SwappedF32
    SwappedF64 SwappedI16 SwappedI24 SwappedI32 SwappedI64 SwappedU16 SwappedU24 SwappedU32
    SwappedU64 Table Text Timed Transport TransportError U16 U24 U32 U64 U8 UNFIT UnknownFrame
    WriteStuckError
    """
)
