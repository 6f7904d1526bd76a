"""The picture of the explorer in its how-to, made anew: python -m tests.docs.explorer_picture."""

from __future__ import annotations

from io import BytesIO

from PIL import Image

from tests.browser import Visit, started
from tests.docs.test_examples import ROOT
from tests.reports.explorer.explored import exploring, opened

PICTURE = ROOT / "docs" / "howto" / "explorer.png"
DESIGN = "--hr-hz 400 --measurement-hz 5 --delay-ms 110 --model ins-gps --within 0.4"
WIDTH, HEIGHT = 1280, 1165
COLOURS = 64
"""Of the file, which is small for it."""

if __name__ == "__main__":
    with started() as browser, exploring("--port", "0", *DESIGN.split()) as explorer:
        visit = Visit(browser.new_context(viewport={"width": WIDTH, "height": HEIGHT}))
        taken = opened(visit, explorer).screenshot()
    Image.open(BytesIO(taken)).convert("RGB").quantize(COLOURS).save(PICTURE, optimize=True)
