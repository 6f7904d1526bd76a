"""How Eqs. (9), (11) and (21) are computed: the same numbers, at different cost and with different rounding."""

from __future__ import annotations

from typing import Literal, TypeAlias

from filters.update_forms import joseph, short, textbook
from filters.update_forms.form import UpdateForm

UpdateFormName: TypeAlias = Literal["textbook", "joseph", "short"]

UPDATE_FORMS: dict[UpdateFormName, UpdateForm] = {
    "textbook": textbook.FORM,
    "joseph": joseph.FORM,
    "short": short.FORM,
}


def update_form(name: UpdateFormName) -> UpdateForm:
    """The update form of this name.

    Raises:
        ValueError: there is none.
    """
    if name not in UPDATE_FORMS:
        raise ValueError(f"update form {name!r} is unknown; give one of {', '.join(UPDATE_FORMS)}")
    return UPDATE_FORMS[name]
