"""The rows of captures as columns."""

SHARES = {"columns-clean": 0.0, "columns-noise-1": 0.01, "columns-noise-10": 0.1}
"""Rows, and the share of noise in the capture of each."""

FILES = {"columns-parquet": "write_parquet", "columns-arrow": "write_arrow"}
"""Rows, and what of `busservo.tables` writes their files."""

ARCHIVES = {"columns-archive-1": 1, "columns-archive-2": 2}
"""Rows, and how many processes work on an archive."""

ROWS = (*SHARES, *FILES, *ARCHIVES)
