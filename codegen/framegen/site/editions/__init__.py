"""The editions of a protocol: which there are, where their pages are, and what changed."""
