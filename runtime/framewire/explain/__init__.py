"""Explanation of frames from the model of a protocol as plain data.

It judges nothing: framegen hands it the verdicts of its reference, and a library those of its own
decoder.
"""
