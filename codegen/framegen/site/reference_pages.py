"""The pages of one reference: the protocol, and each of its messages."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from framegen.site.codec_scripts import codec_scripts
from framegen.site.escape import script_json
from framegen.site.line_data import LINE_SCRIPT, line_data
from framegen.site.page import Page
from framegen.site.protocol_data import protocol_data
from framegen.site.spec_listing import listing

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.targets.docs.reference import PageView, ReferenceView

# The files of the workbench, in the order in which they are joined.
_WORKBENCH = (
    "elements",
    "columns",
    "capture_place",
    "hex_text",
    "code_text",
    "line_text",
    "csv_text",
    "capture_text",
    "capture",
    "notation",
    "event_words",
    "virtual_list",
    "workbench_input",
    "workbench_export",
    "workbench_address",
    "workbench_detail",
    "workbench_list",
    "fields",
    "workbench_encode",
    "workbench",
)

# Those of the page of a message.
_LIVE = ("elements", "notation", "fields", "live")


class ReferencePages:
    """A reference below `folder`, which ends with a slash."""

    def __init__(self, reference: ReferenceView, folder: str) -> None:
        """Take what is to be shown, and where."""
        self.reference = reference
        self.folder = folder

    @cached_property
    def pages(self) -> list[Page]:
        """The pages about the protocol, and then those of its messages."""
        return list(self._made())

    def _made(self) -> Iterator[Page]:
        reference = self.reference
        for view in (*reference.pages, *reference.message_pages):
            yield Page(
                path=f"{self.folder}{view.html}",
                template=view.template,
                title=view.title,
                label=view.label,
                about=view.about,
                folder=self.folder,
                scripts=self._scripts(view.template),
                context={
                    "reference": reference,
                    "message": view.message,
                    **self._data(view),
                },
            )

    def _scripts(self, template: str) -> tuple[tuple[str, ...], ...]:
        shown = {"decoder": (_WORKBENCH, LINE_SCRIPT), "message": (_LIVE,)}.get(template)
        return (codec_scripts(self.reference.model), *shown) if shown else ()

    def _data(self, view: PageView) -> dict[str, object]:
        match view.template:
            case "decoder":
                model = self.reference.model
                return {"data": script_json({**protocol_data(model), "line": line_data(model)})}
            case "message" if view.message is not None:
                own = protocol_data(self.reference.model, [view.message.name])
                return {"live": script_json(own)}
            case "spec":
                compiled = self.reference.compiled
                return {"listing": listing(compiled.source, compiled.tree)}
            case _:
                return {}
