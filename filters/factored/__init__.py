"""How a covariance is kept between gains: all forms give the same gains, at different cost and with different rounding.

The factors of a covariance have about the square root of its condition number, and it cannot become indefinite.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from filters.choice import check_choice
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.factored import conventional, square_root, u_d
from filters.factored.form import FactoredForm

ALLOCATION_FREE = True


FactoredFormName: TypeAlias = Literal["conventional", "square-root", "u-d"]

_FACTORISATIONS: dict[FactoredFormName, FactoredForm] = {"square-root": square_root.FORM, "u-d": u_d.FORM}
FACTORED_FORMS: tuple[FactoredFormName, ...] = ("conventional", *_FACTORISATIONS)


def factored_form(name: FactoredFormName, update: CovarianceFormName = "textbook") -> FactoredForm:
    """The factored form of this name.

    update: the covariance form by which the conventional one multiplies; the others have no use for it.

    Raises:
        ValueError: there is no form of that name, factored or covariance.
    """
    check_choice("form", name, FACTORED_FORMS)
    covariance_form(update)
    return conventional.FORMS[update] if name == "conventional" else _FACTORISATIONS[name]
