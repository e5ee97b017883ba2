"""The command of a library: how it reads what is typed, and how it speaks."""
