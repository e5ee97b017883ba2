"""framegen: makes codecs, a schema, test vectors and documentation of a protocol's spec."""

__version__ = "0.1.0"
