"""How matrices are multiplied in Eqs. (8), (9), (11), (14), (16), (18) and (21).

All forms give the same numbers, at different cost and with different rounding.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from filters.choice import check_choice
from filters.covariance_forms import joseph, short, textbook
from filters.covariance_forms.form import CovarianceForm
from filters.sparse.form import sparse_form
from filters.sparse.structure import Structure

ALLOCATION_FREE = True


CovarianceFormName: TypeAlias = Literal["textbook", "joseph", "short"]

COVARIANCE_FORMS: dict[CovarianceFormName, CovarianceForm] = {
    "textbook": textbook.FORM,
    "joseph": joseph.FORM,
    "short": short.FORM,
}


def covariance_form(name: CovarianceFormName, structure: Structure | None = None) -> CovarianceForm:
    """The covariance form of this name, for matrices of this structure if one is given.

    Raises:
        ValueError: there is none.
    """
    check_choice("update", name, COVARIANCE_FORMS)
    form = COVARIANCE_FORMS[name]
    return form if structure is None else sparse_form(form, structure)
