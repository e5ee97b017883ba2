"""Hex text, valid or not, as a table: for the command, for framegen and for the page's script."""

import random

# Text, and the bytes that it stands for.
HEX = [
    ("55 55 02 07", "55550207"),
    ("55550207", "55550207"),
    ("5555 0207", "55550207"),
    ("aA Bb", "aabb"),
    ("0x55,0x55,0x02,0x07", "55550207"),
    ("0x55, 0x55, 0x2; 0X7", "55550207"),
    ("0X55550207", "55550207"),
    ("0x550x550x02", "555502"),
    ("100x55", "1055"),
    ("0\u00d755 0\u00d75502,0\u00d77", "55550207"),
    (r"\x55\x55\x02\x07", "55550207"),
    (r"\X55 \x2", "5502"),
    (r"0x55\x2", "5502"),
    ("55:55:02:07", "55550207"),
    ("55-55_02;07", "55550207"),
    ("  55\t55\n02,,07,\r\n ", "55550207"),
    ("55\u00a055 \ufeff02", "555502"),
    ("55\v55\f02", "555502"),
    ("55 # zz\n02", "5502"),
    ("# 55\n02#", "02"),
    ("55#aa", "55"),
    ("# nothing\n\n", ""),
    ("", ""),
    (" , ", ""),
]

NO_HEX = [
    "5",
    "555",
    "55 5 02",
    "0x",
    "0x 55",
    "0\u00d7",
    "\u00d755",
    "0x555",
    "0x5 5",
    "0x50x5x",
    "0x5\\x55",
    "x55",
    "\\",
    "\\x",
    "00x5",
    "5G",
    "0xO2",
    "55 55 zz",
    "“55”",
    "55.55",
    "[55]",
    "55\x1b[2J",
    "55\0",
    "55 \u0665\u0665",
    "\uff15\uff15",
    "55\u200955",
    "5# 5",
    "5\n5",
]


def random_texts(count: int) -> list[str]:
    """Return texts that are nearly hex, the same each time."""
    pieces = [
        "0x",
        "\\x",
        "0",
        "5",
        "aF",
        "10",
        "55",
        " ",
        ",",
        "-",
        "#",
        "\n",
        "g",
        "x",
        "\\",
        "\u00a0",
    ]
    chance = random.Random(20)  # noqa: S311 - to be the same each time
    return ["".join(chance.choices(pieces, k=chance.randrange(9))) for _ in range(count)]
