"""Captures as tables: what `tables` is made of. Only here are NumPy and PyArrow imported."""
