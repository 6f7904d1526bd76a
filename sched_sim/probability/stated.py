"""What is known of a job's cost: samples, numbers with probabilities, or a curve of exceedance probabilities."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from itertools import pairwise

from sched_sim.bounds import check_digits, short
from sched_sim.errors import InputError


@dataclass(frozen=True)
class StatedCost:
    """Of one kind of job, in units of cost.

    values: of a sample each execution, in the order in which they ran; else numbers in any order. probabilities: of
    each; None for a sample, whose executions are equally likely. worst: the most that one execution may ever cost, as
    the user declares it; None if they do not. autocorrelation: rank correlation of each execution with the next one,
    where the file says it. source: where it was given, for messages.
    Raises InputError that names the source, for probabilities that are negative or do not sum to 1, and for a worst
    case below a value.
    """

    values: Sequence[Fraction]
    probabilities: Sequence[Fraction] | None = None
    worst: Fraction | None = None
    autocorrelation: float | None = None
    source: str = "cost"

    def __post_init__(self) -> None:
        if wrong := "; ".join(self._wrong()):
            raise InputError(f"{self.source}: {wrong}")

    @property
    def is_sample(self) -> bool:
        return self.probabilities is None

    @property
    def largest(self) -> Fraction:
        return max(self.values)

    def _wrong(self) -> Iterator[str]:
        if not self.values:
            yield "there is no value: give one or more"
            return
        if (least := min(self.values)) <= 0:
            yield f"the value {_shown(least)} must be greater than 0"
        if self.worst is not None and self.worst < self.largest:
            seen = "was measured" if self.is_sample else "has a probability"
            yield f"the worst case {_shown(self.worst)} is below {_shown(self.largest)}, which {seen}: give more"
        if self.probabilities is None:
            return
        if len(self.probabilities) != len(self.values):
            yield f"there are {len(self.values)} values and {len(self.probabilities)} probabilities: give one for each"
        elif wrong := wrong_probabilities(self.probabilities):
            yield wrong


def _total(numbers: Iterable[Fraction]) -> Fraction:
    return sum(numbers, Fraction(0))


def wrong_probabilities(probabilities: Sequence[Fraction]) -> str:
    """What to say of them; empty if they are 0 or more, and sum to 1."""
    if (least := min(probabilities)) < 0:
        return f"the probability {_shown(least)} is negative: give numbers from 0 to 1"
    if (total := _total(probabilities)) != 1:
        return (
            f"the probabilities sum to {_shown(total)}, {_shown(abs(total - 1))} too "
            f"{'much' if total > 1 else 'little'}: they must sum to 1; mend one, or leave it out for one value, which "
            f"gets the rest"
        )
    return ""


def with_the_rest(probabilities: Sequence[Fraction | None], source: str) -> list[Fraction]:
    """One that is not said is what the others leave. Raises InputError where that is nothing, or several are not."""
    unsaid = probabilities.count(None)
    said = _total(one for one in probabilities if one is not None)
    if unsaid > 1:
        raise InputError(
            f"{source}: {unsaid} of {len(probabilities)} values have no probability: leave it out for one at most, "
            f"which gets the rest"
        )
    if unsaid and said >= 1:
        raise InputError(
            f"{source}: the probabilities sum to {_shown(said)}, which leaves nothing for the value without one"
        )
    return [1 - said if one is None else one for one in probabilities]


def by_exceedance(
    values: Sequence[Fraction], exceedance: Sequence[Fraction], worst: Fraction | None, source: str
) -> StatedCost:
    """The cost of a curve, such as a pWCET curve: with the probability exceedance[i] it is more than values[i].

    What lies between two values counts as the larger one: no cost of the curve has a larger probability of being
    exceeded. What is beyond the last is the worst case. Raises InputError for a curve that rises, and for one that does
    not end with 0 where there is no worst case.
    """
    wrong = ""
    if len(values) != len(exceedance):
        wrong = f"there are {len(values)} values and {len(exceedance)} exceedance probabilities: give one for each"
    elif not values:
        wrong = "there is no value: give one or more"
    elif any(after <= before for before, after in pairwise(values)):
        wrong = "the values must rise, each with the probability that more is taken"
    elif any(after > before for before, after in pairwise((Fraction(1), *exceedance))) or exceedance[-1] < 0:
        wrong = "the exceedance probabilities must not rise, and lie from 1 to 0"
    elif exceedance[-1] and worst is None:
        wrong = (
            f"beyond {_shown(values[-1])} there is a probability of {_shown(exceedance[-1])}: say with worst = ... "
            f"what is never exceeded, or end the curve with 0; nothing is extrapolated"
        )
    if wrong:
        raise InputError(f"{source}: {wrong}")
    steps = [1 - exceedance[0], *(before - after for before, after in pairwise(exceedance))]
    if exceedance[-1]:
        assert worst is not None
        if worst <= values[-1]:
            raise InputError(
                f"{source}: the worst case {_shown(worst)} is not above {_shown(values[-1])}, which is exceeded with a "
                f"probability of {_shown(exceedance[-1])}: give more"
            )
        values, steps = [*values, worst], [*steps, exceedance[-1]]
    there = [(value, step) for value, step in zip(values, steps, strict=True) if step]
    return StatedCost([value for value, _ in there], [step for _, step in there], worst, source=source)


def probability(value: int | str | Decimal, what: str) -> Fraction:
    """The exact number that is written, from "1e-30" on, or a quotient, "1/3". Raises InputError for anything else."""
    text = str(value).strip()
    try:
        for part in text.split("/"):
            check_digits(Decimal(part), what)
        return Fraction(text)
    except InputError:
        raise
    except (ArithmeticError, ValueError):
        raise InputError(f"{what} is {short(text)!r}: give a probability, such as 1e-6 or 1/3") from None


def _shown(value: Fraction) -> str:
    return f"{float(value):.15g}"
