"""Cut captures into independent pieces, and write these into one dataset."""
