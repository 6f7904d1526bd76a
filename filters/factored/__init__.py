"""How a covariance is kept between gains: all forms give the same gains, at different cost and with different rounding.

The factors of a covariance have about the square root of its condition number, and it cannot become indefinite.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.factored import conventional
from filters.factored.form import FactoredForm

FactoredFormName: TypeAlias = Literal["conventional", "square-root", "u-d"]

FACTORED_FORMS: dict[FactoredFormName, FactoredForm] = {}


def factored_form(name: FactoredFormName, update: CovarianceFormName = "textbook") -> FactoredForm:
    """The factored form of this name.

    update: the covariance form by which the conventional one multiplies; the others have no use for it.

    Raises:
        ValueError: there is no form of that name.
    """
    covariance_form(update)
    if name == "conventional":
        return conventional.FORMS[update]
    if name not in FACTORED_FORMS:
        raise ValueError(
            f"factored form {name!r} is unknown; give one of {', '.join(('conventional', *FACTORED_FORMS))}"
        )
    return FACTORED_FORMS[name]
