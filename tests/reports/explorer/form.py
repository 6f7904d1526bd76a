"""The controls of the explorer's page, as a person finds and moves them."""

from __future__ import annotations

from playwright.sync_api import Locator, Page


def field(page: Page, label: str) -> Locator:
    return page.get_by_label(label, exact=True).filter(visible=True)


def slider(page: Page, label: str) -> Locator:
    return field(page, f"{label}, slider")


def give(page: Page, label: str, text: str) -> None:
    field(page, label).fill(text)
    field(page, label).press("Enter")


def drag(page: Page, dragged: Locator, *shares: float) -> None:
    """With the mouse, from a share of its length to the others."""
    dragged.scroll_into_view_if_needed()
    box = dragged.bounding_box()
    assert box is not None
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + shares[0] * box["width"], middle)
    page.mouse.down()
    for share in shares[1:]:
        page.mouse.move(box["x"] + share * box["width"], middle, steps=4)
    page.mouse.up()


def unfold(page: Page) -> None:
    """All that is folded in the form."""
    for summary in page.locator("form details:not([open]) > summary").all():
        summary.click()
