"""Asks a codec that somebody else wrote, in any language, and compares it with the reference."""
