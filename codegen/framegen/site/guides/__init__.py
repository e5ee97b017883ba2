"""The guides: their plan, their Markdown as HTML, and what they link to."""
