"""Conformance tests: questions to a codec in any language, compared with the reference."""
