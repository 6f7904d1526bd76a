"""The documentation site: `make docs` writes it to build/docs."""

import sys
from importlib.metadata import version as installed
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "extensions"))

project = "sched_sim"
copyright = "the sched_sim authors"
version = release = installed("sched-sim")
extensions = ["myst_parser", "sphinx.ext.autodoc", "commands", "docstrings", "drawn", "equations", "published", "wide"]
exclude_patterns = ["extensions"]
nitpicky = True
# shown as these names, not as all that they stand for
ALIASES = ("ArrayLike", "Costs", "FloatArray", "Floats", "Number", "RandomCosts")
nitpick_ignore = [
    *(("py:class", name) for name in ALIASES),
    ("py:class", "studies.selection.in_scenario.Question"),  # of a model that was read, as `question_of` makes it
    ("py:class", "studies.machines.ranges.Measured"),  # any type, of the figure and of what it is a figure of
    ("py:class", "filters.jobs.Job"),  # part of a UserFilter, of no use without the arguments that are made for it
]
nitpick_ignore_regex = [("py:class", r"[a-z]+|(?!(filters|reports|sched_sim|studies)\.).+\..+")]  # others' types

myst_enable_extensions = ["deflist", "dollarmath"]
myst_heading_anchors = 3
autodoc_typehints = "description"
autodoc_default_options = {"members": True}
autodoc_preserve_defaults = True
autodoc_type_aliases = {name: name for name in ALIASES}
autodoc_member_order = "bysource"
smartquotes = False  # --costs is no dash
highlight_language = "text"

html_theme = "furo"
html_title = "sched_sim"
html_static_path = ["wide.css"]
html_css_files = ["wide.css"]
html_copy_source = False
html_show_sphinx = False
html_theme_options = {"footer_icons": []}
