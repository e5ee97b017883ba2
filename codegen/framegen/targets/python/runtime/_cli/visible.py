"""What makes text of others harmless, where `console` looks for it."""

from __future__ import annotations

from .._frame.visible import visible, visible_lines

__all__ = ["visible", "visible_lines"]
