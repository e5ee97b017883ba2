"""When a frame that has begun to arrive is given up."""

from __future__ import annotations

GAP = 0.05
"""How many seconds of silence end it: longer than the latency of any adapter, which gathers bytes
for up to 16 ms."""
