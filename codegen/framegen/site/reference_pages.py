"""The pages of one reference: the protocol, and each of its messages."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from framegen.site.downloads import Downloads
from framegen.site.editions.what_changed import what_changed
from framegen.site.escape import script_json
from framegen.site.page import Page
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.line_data import LINE_SCRIPT, line_data
from framegen.site.scripts.protocol_data import protocol_data
from framegen.site.spec_listing import listing

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from markupsafe import Markup

    from framegen.comparison.edition import Edition
    from framegen.site.editions.reference_editions import ReferenceEditions
    from framegen.site.project import Project
    from framegen.targets.docs.reference import PageView

# The files of the workbench, in the order in which they are joined.
_WORKBENCH = (
    "elements",
    "save_file",
    "strip",
    "columns",
    "capture_place",
    "code_text",
    "line_text",
    "csv_text",
    "log_text",
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
_LIVE = ("elements", "strip", "notation", "fields", "live")


class ReferencePages:
    """The reference of one edition, below `folder`, which ends with a slash."""

    def __init__(
        self,
        editions: ReferenceEditions,
        edition: Edition,
        project: Project,
        rules: Callable[[], Mapping[str, str]],
    ) -> None:
        """Take what is to be shown, and what stands beside it."""
        self.editions = editions
        self.edition = edition
        self.reference = editions.views[edition]
        self.folder = editions.root(edition)
        self.downloads = Downloads(self.reference, project.files)
        self._rules = rules

    @property
    def full_title(self) -> str:
        """The title of the protocol, and the version where that is not the newest."""
        title = self.reference.protocol.title
        return title if self._is_newest else f"{title} {self.edition.version}"

    @property
    def files(self) -> dict[str, str]:
        """The files that are no pages, by path below the root of the site."""
        return {f"{self.folder}{path}": text for path, text in self.downloads.texts.items()}

    @cached_property
    def pages(self) -> list[Page]:
        """The pages about the protocol, and then those of its messages."""
        return list(self._made())

    def _made(self) -> Iterator[Page]:
        reference = self.reference
        for view in (*reference.pages, *reference.message_pages):
            notice = self.editions.notice(self.edition, view)
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
                    "edition": notice,
                    **self._data(view),
                },
                canonical=notice.canonical,
            )

    def _scripts(self, template: str) -> tuple[tuple[str, ...], ...]:
        # A codec on each page of each edition is most of a site: older ones have their workbench.
        if template == "message" and not self._is_newest:
            return ()
        shown = {"decoder": (_WORKBENCH, LINE_SCRIPT), "message": (_LIVE,)}.get(template)
        return (codec_scripts(self.reference.model), *shown) if shown else ()

    @property
    def _is_newest(self) -> bool:
        return self.edition is self.editions.versions.newest

    def _live_data(self, message: str) -> Markup:
        return script_json(protocol_data(self.reference.model, [message]))

    def _data(self, view: PageView) -> dict[str, object]:
        match view.template:
            case "decoder":
                model = self.reference.model
                return {"data": script_json({**protocol_data(model), "line": line_data(model)})}
            case "message" if view.message is not None:
                return {"live": self._live_data(view.message.name) if self._is_newest else None}
            case "spec":
                compiled = self.reference.compiled
                return {"listing": listing(compiled.source, compiled.tree)}
            case "changelog":
                return {"versions": what_changed(self.editions, self.edition, self._rules())}
            case "downloads":
                return {"downloads": self.downloads}
            case _:
                return {}
