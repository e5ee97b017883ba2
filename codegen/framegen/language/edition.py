"""The editions of the language.

Keys are added under the same number. It rises when a meaning changes, and every edition is read
for ever.
"""

from __future__ import annotations

# From this edition on, the first endpoint is the library's user; before, whoever sent first was.
FIRST_ENDPOINT_IS_CLIENT = 2

LATEST = 2
