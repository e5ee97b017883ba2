"""The spec as its author wrote it: the keys of the language, its types and its notations."""
