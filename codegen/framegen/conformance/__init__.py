"""Asks a codec that somebody else wrote, in any language, and holds its answers to the reference."""
