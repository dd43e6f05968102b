"""Mouse, touch, keyboard and address of the page, and its picture."""

import time

import numpy
import pytest
from PIL import Image

from views import box_of, changes, difference, drawn_share, settled_view, state


def test_mouse(page):
    left, top, width, height = box_of(page, "view")
    middle = numpy.array([left + width / 2, top + height / 2])
    assert changes(page, lambda: page.drag(middle, middle + [80, 30])) > 0.05
    turned = state(page)
    assert float(turned["az"]) == pytest.approx(30 - 80 * 0.45, abs=3) and float(turned["el"]) > 18
    assert changes(page, lambda: page.drag(middle, middle + [60, 0], button="right")) > 0.05
    moved = state(page)
    assert moved["az"] == turned["az"] and {"x", "z"} & set(moved)
    wheel = lambda: page.mouse("mouseWheel", *middle, button="none", buttons=0, deltaX=0, deltaY=-240)  # noqa: E731
    assert changes(page, wheel) > 0.05
    assert float(state(page)["zoom"]) > 0
    page.click(*middle, count=1)
    page.click(*middle, count=2)
    page.settle()


def test_touch(page):
    left, top, width, height = box_of(page, "view")
    x, y = left + width / 2, top + height / 2

    def touch(kind, *points):
        page.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": a, "y": b, "id": i} for i, (a, b) in enumerate(points)])

    def turn():
        touch("touchStart", (x, y))
        for i in range(1, 5):
            touch("touchMove", (x + 20 * i, y))
        touch("touchEnd")

    def pinch():
        touch("touchStart", (x - 40, y), (x + 40, y))
        for i in range(1, 5):
            touch("touchMove", (x - 40 - 15 * i, y), (x + 40 + 15 * i, y))
        touch("touchEnd")

    assert changes(page, turn) > 0.05
    assert "az" in state(page)
    before = drawn_share(settled_view(page))
    assert changes(page, pinch) > 0.05
    assert drawn_share(settled_view(page)) > before


def test_keys_and_presets(page):
    page.js("document.getElementById('view').focus()")
    start = settled_view(page)
    for key in ("ArrowLeft", "ArrowUp", "+", "-"):
        assert changes(page, lambda key=key: page.key(key)) > 0.003, key
    assert changes(page, lambda: page.key("ArrowRight", shift=True)) > 0.02
    assert changes(page, lambda: page.key("0")) > 0.02
    assert difference(start, settled_view(page)) < 0.002
    page.key("Enter")
    assert page.text("picked-id")
    page.key("Escape")
    assert "Click a face" in page.text("picked")
    pictures = {}
    for name in ("corner", "front", "right", "back", "left", "top", "bottom"):
        page.js(f"document.getElementById('view-{name}').click()")
        pictures[name] = settled_view(page)
    for name, one in pictures.items():
        for other_name, other in pictures.items():
            assert name == other_name or difference(one, other) > 0.02, f"{name}, {other_name}"
    page.js("document.getElementById('reset').click()")
    assert difference(start, settled_view(page)) < 0.002
    page.choose("map", "turbo")
    page.js("document.getElementById('reset-all').click()")
    assert difference(start, settled_view(page)) < 0.002


def test_png(page, tmp_path):
    page.call("Page.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
    view = settled_view(page)
    page.js("document.getElementById('png').click()")
    end = time.monotonic() + 10
    while not list(tmp_path.glob("*.png")) and time.monotonic() < end:
        time.sleep(0.05)
    [path] = tmp_path.glob("*.png")
    assert path.name == "animal.png"
    picture = Image.open(path).convert("RGB")
    assert picture.size == (view.size[0], view.size[1] + 84)
    assert difference(picture.crop((0, 0, *view.size)), view) < 0.01
    assert drawn_share(picture.crop((0, view.size[1], *picture.size))) > 0.02


def test_address_keeps_the_state(page, open_page, animal):
    page.choose("layer", "thickness")
    page.choose("map", "cividis")
    page.choose("shading", "smooth")
    page.choose("clip", "view")
    page.choose("clip-at", 0.4)
    page.js("document.getElementById('view-left').click()")
    page.js("document.getElementById('view').focus()")
    page.key("Enter")
    page.js("document.activeElement.blur()")
    before = settled_view(page)
    fragment = page.js("new Promise((done) => setTimeout(() => done(location.hash), 400))")
    assert {"layer=thickness", "map=cividis", "az=-90"} <= set(fragment[1:].split("&"))
    again = open_page(animal.address + fragment)
    assert difference(before, settled_view(again)) < 0.002
    assert again.text("picked-id") == page.text("picked-id")
    # An address that the user enters, with values that do not exist.
    again.js("location.hash = '#layer=nothing&map=red&low=x&show=7&face=9:9&zoom=-3&el=500'")
    again.settle()
    assert again.js("document.getElementById('map').value") == "viridis"
    assert again.js("document.getElementById('layer').value") == "sdf"


def test_keyboard_reaches_everything(page):
    page.js("document.getElementById('tab-more').click()")
    wanted = page.js("""[...document.querySelectorAll('button, input, select, summary, [tabindex]')]
        .filter((e) => e.checkVisibility() && !e.matches(':disabled')).map((e) => e.id || e.textContent)""")
    reached, unseen = [], []
    for _ in range(len(wanted) + 3):
        page.key("Tab")
        name, outline = page.js("""(() => { const e = document.activeElement, s = getComputedStyle(e);
            return [e === document.body ? null : e.id || e.textContent, s.outlineStyle !== 'none' && parseFloat(s.outlineWidth)]; })()""")
        if name is not None:
            reached.append(name)
            if not outline:
                unseen.append(name)
    assert set(wanted) <= set(reached)
    assert unseen == []
    nodes = page.call("Accessibility.getFullAXTree")["nodes"]
    focusable = [n for n in nodes if any(p["name"] == "focusable" and p["value"]["value"] for p in n.get("properties", []))]
    nameless = [n["role"]["value"] for n in focusable if not n.get("name", {}).get("value")
                and n["role"]["value"] not in ("RootWebArea", "generic")]
    assert len(focusable) >= len(wanted) and nameless == []
    # Space and Enter on the controls.
    page.js("document.getElementById('edges').focus()")
    assert changes(page, lambda: page.key(" ")) > 0.02
    page.js("document.getElementById('map').focus()")
    assert changes(page, lambda: page.key("ArrowDown")) > 0.05
    page.js("document.getElementById('view-top').focus()")
    assert changes(page, lambda: page.key("Enter")) > 0.05
