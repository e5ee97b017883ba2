"""Facts of a protocol: what its specification says, and what follows from it; nothing with bytes.

A library carries them as `protocol.json`. They are read where something is to be explained.
"""
