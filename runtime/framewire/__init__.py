"""What libraries of protocols have in common, whatever their protocol.

A library is generated from the specification of its protocol, and knows what that decides. All else
is written here, once. Nothing in here knows a protocol, nor where it lies itself: imports are
relative, so that a copy of the whole folder works below any name.
"""
