"""A spec to begin from, guessed from a recording of a line whose protocol is unknown.

What fits is found by trying all there is, and what fits equally is said, too: nothing is called
decided that another reading of the same bytes would make wrong.
"""
