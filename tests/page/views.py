"""What the tests see of a page: pixels of the view, texts, the state in the address."""

import re
import time

import numpy
from PIL import ImageChops


def box_of(page, element):
    box = page.js(f"(() => {{ const b = document.getElementById('{element}').getBoundingClientRect();"
                  " return [b.left, b.top, b.width, b.height]; })()")
    return numpy.array(box)


def view_picture(page):
    return page.screenshot(area=box_of(page, "view").astype(int))


def settled_view(page):
    page.settle()
    return view_picture(page)


def difference(one, other, least=12):
    """Share of the pixels of which a channel differs by more than `least`."""
    pixels = numpy.asarray(ImageChops.difference(one, other)).max(2)
    return float((pixels > least).mean())


def changes(page, action, least=12):
    """Share of the pixels of the view that the action changes."""
    before = settled_view(page)
    action()
    return difference(before, settled_view(page), least)


def drawn_share(picture):
    pixels = numpy.asarray(picture).astype(int)
    return float((abs(pixels - pixels[2, 2]).max(2) > 12).mean())


def number(text):
    return float(re.sub(r"[^\d.e+-]", "", text.split(" ")[0]))


def state(page):
    page.wait("true")
    time.sleep(0.35)
    return dict(part.split("=") for part in page.js("location.hash.slice(1)").split("&") if part)
