"""What the explorer's server answers to a query: a view, a picture, a table, or why there is none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from threading import Timer
from time import monotonic
from traceback import format_exc

from sched_sim.errors import InputError
from sched_sim.text import json_text

JSON = "application/json"
VIEW = "/view"
"""Where the view of a design is asked for."""
SLOW_S = 5.0
"""After so many seconds the terminal says what is still being computed."""

UNEXPECTED = (
    "This could not be computed, for a reason that nobody thought of: the terminal in which `sched-sim explore` runs "
    "shows it. Other designs can go on."
)
NO_MEMORY = "memory ran out: give a smaller design"


@dataclass(frozen=True)
class Answer:
    """content: bytes of the media type; file: the name under which a browser saves it; status: as HTTP counts."""

    content: bytes
    media: str = JSON
    file: str | None = None
    status: int = 200


Question = Callable[[str], Answer]
"""What is asked at one path: of a query, without its question mark. Raises InputError for one that has no answer."""


def document(value: object, status: int = 200) -> Answer:
    """Plain data as JSON."""
    return Answer(json_text(value).encode(), status=status)


class Asked:
    """Questions asked, one at a time: what came of them, and what a person at the terminal is told meanwhile.

    tell: says something there. last: the query of the design that was viewed last.
    """

    last: str | None = None

    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell
        self.answered = self.refused = self.failed = 0
        self.slowest_s = 0.0

    def answer(self, path: str, question: Question, query: str) -> Answer:
        """Whatever `question` raises becomes an answer; what is not the user's to mend is shown at the terminal."""
        what = f"{path}?{query}"
        timer = Timer(SLOW_S, self._tell, [f"Slow: computing for {SLOW_S:g} s so far: {what}"])
        timer.daemon = True
        timer.start()
        start = monotonic()
        try:
            answer = question(query)
            self.answered += 1
            self.last = query if path == VIEW else self.last
        except InputError as error:
            answer = document({"error": str(error)}, 422)
            self.refused += 1
        except MemoryError:
            answer = document({"error": NO_MEMORY}, 422)
            self.refused += 1
        except BaseException:  # a user's model may raise SystemExit, too
            self._tell(f"Unexpected, at {what}:\n{format_exc()}")
            answer = document({"error": UNEXPECTED}, 500)
            self.failed += 1
        finally:
            timer.cancel()
            self.slowest_s = max(self.slowest_s, monotonic() - start)
        return answer
