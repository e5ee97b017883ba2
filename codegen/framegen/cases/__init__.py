"""Test cases for a codec in any language: frames, bytes that are none, and streams."""
