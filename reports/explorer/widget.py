"""The explorer in a notebook: a widget that shows a design, follows it, and says which one is looked at."""

from __future__ import annotations

from typing import Any

from reports.explorer.compact import compact
from reports.explorer.module import module, stylesheet
from sched_sim.errors import InputError
from studies.explorer.design import Design
from studies.explorer.given import Given
from studies.explorer.query import design_of, query_of
from studies.explorer.view import View, explore

try:
    import traitlets
    from anywidget import AnyWidget
except ImportError:
    raise InputError('reports.Explorer needs the package anywidget: pip install "sched-sim[notebook]"') from None


UNEXPECTED = "This could not be computed, for a reason that nobody thought of: {}: {}"


def _document(view: View, _widget: Any) -> dict[str, Any]:
    return view.document()


class Explorer(AnyWidget):
    """The explorer of one design, as the last line of a cell shows it.

    Give a `Design`, or what it is made of: Explorer(hr_hz=400, measurement_hz=5, delay_ms=110, model="ins-gps");
    without either it is the design that `given` starts with. `design` is what is looked at, and may be set; `view` is
    what `explore` says of it. Both follow what is changed in the page: observe(function, "view") hears of it.

    Raises InputError as `Design` and `explore` do; what is wrong in the page is said there.
    """

    _esm = compact(module("widget"))
    _css = compact(stylesheet())

    query = traitlets.Unicode().tag(sync=True)
    view = traitlets.Instance(View).tag(sync=True, to_json=_document)
    error = traitlets.Unicode().tag(sync=True)
    answered = traitlets.Unicode().tag(sync=True)
    """The query that `view`, or `error`, is of: an event even where another text asks for the same view."""

    def __init__(self, design: Design | None = None, *, given: Given = Given(), **asked: Any) -> None:
        if design is not None and asked:
            raise InputError(f"a design and {', '.join(asked)}: give one Design(...), or its parts")
        self._given = given
        self._design = design or (Design(**asked) if asked else given.start)
        view = explore(self._design, given)
        text = query_of(self._design)
        super().__init__(query=text, view=view, answered=text)
        self.observe(self._answer, "query")

    @property
    def design(self) -> Design:
        """The one that is looked at."""
        return self._design

    @design.setter
    def design(self, design: Design) -> None:
        view = explore(design, self._given)
        self._show(design, view, query_of(design))

    def _answer(self, change: Any) -> None:
        """To what the page asks: always, for it waits."""
        text = change["new"]
        if text == self.answered:
            return
        try:
            design = design_of(text, self._given)
            self._show(design, explore(design, self._given), text)
        except InputError as error:
            self._refuse(str(error), text)
        except Exception as error:
            self._refuse(UNEXPECTED.format(type(error).__name__, error), text)
            raise

    def _refuse(self, why: str, text: str) -> None:
        with self.hold_sync():
            self.error, self.answered = why, text

    def _show(self, design: Design, view: View, text: str) -> None:
        with self.hold_sync():
            self._design = design
            self.error, self.view, self.answered, self.query = "", view, text, text
