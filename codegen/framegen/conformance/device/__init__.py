"""Conformance tests of real firmware over a port: what is sent, how it is judged and reported."""
