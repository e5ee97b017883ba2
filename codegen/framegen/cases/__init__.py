"""What a codec in any language is to be tried on: frames, bytes that are none, and whole lines."""
