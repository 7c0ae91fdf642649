"""The report of `spectrel compare` in a real Chromium without a network: python3 tests/browser/compare.py [SPECTREL]

Needs the Debian package `chromium` (or CHROMIUM=/path/to/it) and requirements.txt beside this file.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

SCENE = """
[render]
width = 96
height = 64
samples = 16

[camera]
position = [0, -12, 4]
look_at = [0, 0, 1]
fov = 30

[environment.gradient]
zenith = { spectrum = "D65", luminance = 200 }
horizon = { spectrum = "D65", luminance = 60 }
nadir = { spectrum = "D65", luminance = 5 }

[materials."a <i>b</i> &amp; c".conductor]
ior = "Ti/palm-2018"

[[objects]]
material = "iron"
shape.rectangle = { size = [40, 40] }

[[objects]]
material = "gold"
shape.sphere = { center = [-1.6, 0, 1.501], radius = 1.5 }

[[objects]]
material = "diamond"
shape.sphere = { center = [1.6, 0, 1.501], radius = 1.5 }

[[objects]]
material = "a <i>b</i> &amp; c"
shape.sphere = { center = [0, -2, 0.501], radius = 0.5 }
"""

CLIP = "getComputedStyle(document.getElementById('right-picture')).clipPath"
# Pictures that do not show, or whose pixels are all alike.
BROKEN = "[...document.images].filter(image => !image.complete || image.naturalWidth === 0).map(image => image.id)"
PIXELS = """id => {
  const image = document.getElementById(id), canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
  canvas.getContext('2d').drawImage(image, 0, 0);
  return canvas.toDataURL();
}"""


def report(spectrel, folder):
    (folder / "scene.toml").write_text(SCENE)
    varied = ["--vary", "a <i>b</i> &amp; c=silver", "--ior", "gold=Au/johnson-christy-1972"]
    subprocess.run(
        [spectrel, "compare", "scene.toml", "--quiet", "--models", "exact,schlick,constant", *varied],
        cwd=folder,
        check=True,
    )
    return (folder / "scene-compare" / "report.html").resolve().as_uri()


class Page:
    """A report on a screen of some size, and whatever goes wrong on it."""

    def __init__(self, browser, address, width, scheme):
        self.faults = []
        context = browser.new_context(
            viewport={"width": width, "height": 800}, color_scheme=scheme, offline=True, has_touch=width < 500
        )
        self.page = context.new_page()
        self.page.on("console", lambda message: self.faults.append(f"{message.type}: {message.text}"))
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("request", lambda request: self.ask(request.url))
        self.address = address
        self.page.goto(address)
        self.page.wait_for_function("[...document.images].every(image => image.complete)")

    def ask(self, url):
        if url != self.address and not url.startswith("data:"):
            self.faults.append(f"asks for {url}")

    def edge(self):
        """Where the right picture begins, in percent from the left."""
        clip = self.page.evaluate(CLIP)
        assert clip.startswith("inset("), clip
        return float(clip.rstrip(")").split()[-1].rstrip("%"))


def check_pictures(screen):
    assert screen.page.evaluate("document.images.length") == 5 + 4 * 2 + 2
    assert screen.page.evaluate(BROKEN) == []


def check_slider(screen):
    slider = screen.page.locator("#slider")
    assert screen.edge() == 50
    slider.focus()
    slider.press("ArrowRight")
    slider.press("ArrowRight")
    assert screen.edge() == 51, screen.edge()
    slider.press("Home")
    assert screen.edge() == 0
    slider.fill("80")
    assert screen.edge() == 80
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    x, y = box["x"], box["y"] + 0.5 * box["height"]
    screen.page.mouse.move(x + 0.3 * box["width"], y)
    screen.page.mouse.down()
    assert abs(screen.edge() - 30) < 1, screen.edge()
    screen.page.mouse.move(x + 0.6 * box["width"], y)
    screen.page.mouse.up()
    assert abs(screen.edge() - 60) < 1, screen.edge()


def check_touch(screen):
    slider = screen.page.locator("#slider")
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    screen.page.touchscreen.tap(box["x"] + 0.25 * box["width"], box["y"] + 0.5 * box["height"])
    assert abs(screen.edge() - 25) < 2, screen.edge()


def check_choices(screen):
    page = screen.page
    exact, schlick = page.evaluate(PIXELS, "left-picture"), page.evaluate(PIXELS, "right-picture")
    assert exact != schlick
    page.select_option("#right", "picture-2")
    page.wait_for_function("document.getElementById('right-picture').complete")
    constant = page.evaluate(PIXELS, "right-picture")
    assert constant not in (exact, schlick) and page.inner_text("#right-tag") == "constant"
    page.select_option("#left", "delta-e-2")
    page.wait_for_function("document.getElementById('left-picture').complete")
    assert page.evaluate(PIXELS, "left-picture") == page.evaluate(PIXELS, "delta-e-2")
    assert page.inner_text("#left-tag") == "ΔE2000: constant"
    # A small picture by keyboard.
    page.locator(".thumb").nth(1).focus()
    page.keyboard.press("Enter")
    assert page.input_value("#right") == "picture-1"
    assert page.locator(".thumb[aria-pressed=true]").count() == 1


def check_names(screen):
    """What a file calls its materials is text, never markup."""
    assert screen.page.locator("i").count() == 0
    assert "a <i>b</i> &amp; c → silver" in screen.page.inner_text("#right")


def check_width(screen, width):
    assert screen.page.evaluate("document.documentElement.scrollWidth") <= width


def check_keyboard(screen):
    """Everything that can be used is reached by the tabulator and has a name."""
    unnamed = """[...document.querySelectorAll('select, input, button')].filter(
      element => !element.ariaLabel && !element.labels?.length && !element.textContent.trim()).length"""
    assert screen.page.evaluate(unnamed) == 0
    reached = set()
    for _ in range(12):
        screen.page.keyboard.press("Tab")
        reached.add(screen.page.evaluate("document.activeElement.id || document.activeElement.className"))
    assert {"left", "right", "slider", "thumb", "scroll"} <= reached, reached


def main():
    spectrel = str(Path(sys.argv[1] if len(sys.argv) > 1 else "target/release/spectrel").resolve())
    chromium = os.environ.get("CHROMIUM", "/usr/bin/chromium")
    screens = [(1280, "light"), (1280, "dark"), (390, "light"), (390, "dark")]
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        address = report(spectrel, Path(folder))
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        for width, scheme in screens:
            screen = Page(browser, address, width, scheme)
            check_keyboard(screen)
            check_pictures(screen)
            check_slider(screen)
            check_choices(screen)
            check_names(screen)
            check_width(screen, width)
            if width < 500:
                check_touch(screen)
            assert screen.faults == [], screen.faults
        browser.close()
    print(f"{len(screens)} passed, 0 failed")


if __name__ == "__main__":
    main()
