"""Captures as tables: what `tables` is made of. What is in here imports NumPy and PyArrow."""
