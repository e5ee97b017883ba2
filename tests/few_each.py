"""How long a property is searched that each message, protocol or method is held to.

All of these share what holds them, so that together they search longer than a property that is
searched once; and a number of examples that stood here would hold the long searches back.
"""

from hypothesis import settings

_OF_ONE = settings().max_examples
few_each = settings(max_examples=min(_OF_ONE, max(10, _OF_ONE * 2 // 5)))
