"""Explanation of frames from the facts of a protocol.

It judges nothing: framegen hands it the verdicts of its reference, and a library those of its own
decoder.
"""
