"""Compare two editions of a spec: what its users notice, who of them, and why.

Nothing is judged by the kind of a change. What the ends of a line make of each other's frames is
tried out with the reference codec of both editions (`wire`), what they wait for is played
(`conversation`), and what a program can name is read from the library that is generated
(`programs`). Each of these gives effects; the changes that explain them are told by `changes`.
"""
