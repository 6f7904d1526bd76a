"""How matrices are multiplied in Eqs. (8), (9), (11), (14), (16), (18) and (21).

All forms give the same numbers, at different cost and with different rounding.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from filters.choice import check_choice
from filters.covariance_forms import joseph, short, textbook
from filters.covariance_forms.form import CovarianceForm

ALLOCATION_FREE = True


CovarianceFormName: TypeAlias = Literal["textbook", "joseph", "short"]

COVARIANCE_FORMS: dict[CovarianceFormName, CovarianceForm] = {
    "textbook": textbook.FORM,
    "joseph": joseph.FORM,
    "short": short.FORM,
}


def covariance_form(name: CovarianceFormName) -> CovarianceForm:
    """The covariance form of this name.

    Raises:
        ValueError: there is none.
    """
    check_choice("update", name, COVARIANCE_FORMS)
    return COVARIANCE_FORMS[name]
