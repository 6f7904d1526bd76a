"""A small host of anywidgets: a page with a model whose changes reach a widget of this process, and back."""

from __future__ import annotations

import json
from itertools import count
from typing import Any

import pytest
from playwright.sync_api import Page

pytest.importorskip("anywidget", reason="the extra notebook is not installed")

from reports.explorer.widget import Explorer

HOST = """<!doctype html><html lang="en"><title>notebook</title><style>%s</style><body><main></main>
<script type="module">
%s
const state = %s;
const heard = {};
const fire = (name) => (heard[`change:${name}`] ?? []).forEach((callback) => callback());
const changed = new Set();
const take = (next) => {
  const names = Object.keys(next).filter((name) => JSON.stringify(next[name]) !== JSON.stringify(state[name]));
  Object.assign(state, next);
  names.forEach(fire);
};
const model = {
  get: (name) => state[name],
  set: (name, value) => { state[name] = value; changed.add(name); fire(name); },
  on: (event, callback) => { (heard[event] ??= []).push(callback); },
  off: (event, callback) => { heard[event] = (heard[event] ?? []).filter((other) => other !== callback); },
  save_changes: async () => {
    const sent = Object.fromEntries([...changed].map((name) => [name, state[name]]));
    changed.clear();
    if (Object.keys(sent).length) take(await window.%s(sent));
  },
};
window.take = take;
window.end = widget.render({ model, el: document.querySelector("main") });
</script>"""
NUMBERS = count()
"""A page keeps what is exposed to it."""
SYNCED = ("query", "answered", "error", "view")


def hosted(page: Page, widget: Explorer, *, answers: bool = True) -> None:
    """Shows it. Changes of the model are set on the widget, whose state comes back, as a comm would bring it; unless it
    does not answer."""
    name = f"python{next(NUMBERS)}"
    page.expose_function(name, lambda sent: _set(widget, sent) if answers else {})
    script = widget._esm.replace("export default", "const widget =")
    page.set_content(HOST % (widget._css, script, json.dumps(state(widget)).replace("<", r"\\u003c"), name))


def state(widget: Explorer) -> dict[str, Any]:
    """What the page is told."""
    return {name: value for name, value in widget.get_state().items() if name in SYNCED}


def sent(page: Page, widget: Explorer) -> None:
    """The state that Python set."""
    page.evaluate("(next) => window.take(next)", state(widget))


def _set(widget: Explorer, sent: dict[str, Any]) -> dict[str, Any]:
    for name, value in sent.items():
        setattr(widget, name, value)
    return state(widget)
