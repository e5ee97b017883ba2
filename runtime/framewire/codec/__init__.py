"""Bytes to messages and back: single frames, streams, noise and look-alikes."""
