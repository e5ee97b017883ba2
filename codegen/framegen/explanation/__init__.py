"""Explanation of frames from the model as plain data; the Python target copies it into libraries.

It imports the standard library and its neighbours alone, and judges nothing: framegen hands it the
verdicts of its reference, and a library those of its own decoder.
"""
