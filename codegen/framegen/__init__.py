"""framegen: from a protocol written down as data to codecs, schema, vectors and documentation."""

__version__ = "0.1.0"
