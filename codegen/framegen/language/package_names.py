"""The names that no protocol can have: it names a package, a command and folders beside others.

A name is taken by what Python has under it, by what is imported beside a library, or by a system.
Modules are those of Python 3.10 to 3.13 on all systems, keywords and builtins likewise: the same
spec is accepted on every one.
"""

from __future__ import annotations


def words(text: str) -> frozenset[str]:
    """Return the words of a text."""
    return frozenset(text.split())


# The last line are soft keywords.
KEYWORDS = words(
    """
    and as assert async await break class continue def del elif else except
    finally for from global if import in is lambda nonlocal not or pass raise return try while
    with yield
    case match type
    """
)

# What an argument or a property of the same name would hide.
BUILTINS = words(
    """
    abs aiter all anext any ascii bin bool breakpoint bytearray bytes callable chr classmethod
    compile complex copyright credits delattr dict dir divmod enumerate eval exec exit filter
    float format frozenset getattr globals hasattr hash help hex id input int isinstance
    issubclass iter len license list locals map max memoryview min next object oct open ord pow
    print property quit range repr reversed round set setattr slice sorted staticmethod str sum
    super tuple vars zip
    """
)

MODULES = words(
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
PACKAGES = words(
    """
    framegen framewire hid hypothesis jinja2 matplotlib numpy pandas polars pyarrow pydantic pytest
    serial shtab tomli typing_extensions yaml
    """
)

# What Windows keeps for devices.
DEVICES = frozenset(["con", "prn", "aux", "nul"]) | {
    f"{port}{number}" for port in ("com", "lpt") for number in range(10)
}

_TAKEN = (
    (KEYWORDS, "is a word of Python itself"),
    (BUILTINS, "would hide what Python has under this name"),
    (MODULES, "is a module of Python's standard library"),
    (PACKAGES, "is a package that is used beside the library"),
    (DEVICES, "is a device on Windows, and no folder there"),
)
_SIMULATOR = "_simulator"


def why_taken(name: str) -> str:
    """Return why no protocol can have this name, behind it in a sentence; empty where one can."""
    if name.endswith(_SIMULATOR):
        return "is where a library looks for the simulator of another protocol"
    return next((why for taken, why in _TAKEN if name in taken), "")
