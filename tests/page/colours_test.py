"""Colours, layers, limits and lists of the page, picked faces, and two meshes side by side."""

import math
import re

import numpy
import pytest

from meshes import MAPS, viridis
from views import box_of, changes, difference, drawn_share, number, settled_view, state

# A view along -z that the tests compute themselves, without light: a pixel has the colour of its face.
KNOWN_VIEW = "#shading=plain&az=0&el=0&zoom=2&x=0&y=0&z=0&up=y"


def known_faces(page, mesh, count):
    """(x, y, face) in pixels of the view, computed from the mesh."""
    left, top, width, height = box_of(page, "view")
    size = mesh.high - mesh.low
    # The broad side is in front: along x where the mesh is longer in z.
    front = numpy.array([0, 0, 1.0]) if size[0] >= size[2] else numpy.array([1.0, 0, 0])
    up = numpy.array([0, 1.0, 0])
    right = numpy.cross(up, front)
    pixel = mesh.radius / min(width, height)
    random = numpy.random.default_rng(7)
    found = []
    while len(found) < count:
        x, y = random.integers(int(width * 0.2), int(width * 0.8)), random.integers(int(height * 0.2), int(height * 0.8))
        face = mesh.seen((x + 0.5 - width / 2) * pixel, (height / 2 - y - 0.5) * pixel, right, up, front)
        if face >= 0 and all(face != other for _, _, other in found):
            found.append((x, y, face))
    return [(left + x, top + y, face) for x, y, face in found]


def test_colours_of_known_faces(open_page, animal):
    values = animal.fields["sdf"]
    low, high = numpy.percentile(values, 20), numpy.percentile(values, 80)
    page = open_page(animal.address + KNOWN_VIEW + f"&low={low}&high={high}")
    page.settle()
    picture = page.screenshot()
    for x, y, face in known_faces(page, animal, 25):
        expected = viridis(values[face], low, high)
        assert abs(numpy.array(picture.getpixel((int(x), int(y)))) - expected).max() <= 4, f"face {face}"


@pytest.mark.parametrize("name", MAPS)
def test_colour_maps(page, name):
    page.choose("map", name)
    page.choose("shading", "plain")
    page.settle()
    stops = MAPS[name]
    ends = [box_of(page, f"legend-{end}") for end in ("low", "high")]
    y = int(box_of(page, "legend")[1] + 51)
    columns = [box[0] + box[2] / 2 for box in ends]
    page.js("for (const end of document.querySelectorAll('.end')) end.style.opacity = 0")
    picture = page.screenshot()
    # Outside of the range of the colours, the bar has the colours of the ends.
    for x, expected in zip((math.floor(columns[0] - 0.5), int(sum(columns) / 2), math.ceil(columns[1] + 0.5)), stops):
        assert abs(numpy.array(picture.getpixel((x, y))) - expected).max() <= 6


def test_picking(open_page, animal):
    page = open_page(animal.address + KNOWN_VIEW)
    fields = animal.fields
    for x, y, face in known_faces(page, animal, 8):
        page.click(x, y)
        assert number(page.text("picked-id").replace(",", "")) == face
        for name in ("sdf", "error", "thickness"):
            shown, value = page.text(f"picked-0-{name}"), fields[name][face]
            if numpy.isnan(value):
                assert shown == "no value"
            else:
                assert number(shown) == pytest.approx(value, rel=2e-3, abs=1e-12)
        assert page.text("picked-0-seed").startswith("seed" if fields["seed"][face] else "interpolated")
        assert page.text("picked-0-segment") == f"part {fields['segment'][face]}"
    assert not page.js("document.getElementById('ring-0').hidden")
    left, top, *_ = box_of(page, "view")
    page.click(left + 5, top + 5)
    assert "Click a face" in page.text("picked")


def test_go_to_face(page, animal):
    face = int(numpy.nanargmax(animal.fields["sdf"]))
    page.js("document.getElementById('tab-more').click()")
    page.js("document.getElementById('face-number').focus()")
    page.call("Input.insertText", text=str(face))
    assert changes(page, lambda: page.key("Enter")) > 0.05
    assert number(page.text("picked-0-sdf")) == pytest.approx(animal.fields["sdf"][face], rel=2e-3)
    ring, (left, top, width, height) = box_of(page, "ring-0"), box_of(page, "view")
    assert abs(ring[0] + ring[2] / 2 - left - width / 2) < 3 and abs(ring[1] + ring[3] / 2 - top - height / 2) < 3
    page.js("document.getElementById('face-number').value = 99999999")
    page.key("Enter")
    assert page.text("picked") == "There is no face 99999999."


def test_layers(page):
    names = page.js("[...document.getElementById('layer').options].map((option) => option.value)")
    assert names == ["sdf", "seed", "error", "segment", "thickness"]
    pictures = []
    for name in names:
        page.choose("layer", name)
        pictures.append(settled_view(page))
        title = page.js("document.querySelector('#legend canvas').getAttribute('aria-label')")
        assert title.startswith(page.js("document.getElementById('layer').selectedOptions[0].text"))
    for i, one in enumerate(pictures):
        for other in pictures[i + 1:]:
            assert difference(one, other) > 0.02
    page.choose("layer", "segment")
    page.choose("shading", "plain")
    colours = {colour for count, colour in settled_view(page).getcolors(1 << 20) if count > 200}
    assert len(colours - {(255, 255, 255)}) >= 3
    assert page.js("document.getElementById('colours').disabled && document.getElementById('legend-low').hidden")


def test_range(page, animal):
    shown = lambda end: float(page.js(f"document.getElementById('legend-{end}').getAttribute('aria-valuenow')"))  # noqa: E731
    values = animal.fields["sdf"]
    values = values[~numpy.isnan(values)]
    span = values.max() - values.min()
    assert abs(shown("low") - numpy.percentile(values, 1)) < 1e-3 * span
    assert abs(shown("high") - numpy.percentile(values, 99)) < 1e-3 * span
    page.choose("high", (shown("low") + shown("high")) / 2)
    page.settle()
    middle = shown("high")
    # Dragging by half of the bar moves the end by half of the legend.
    x, y = box_of(page, "legend-high")[:2] + 12
    left, _ = box_of(page, "legend-low")[:2] + 12
    assert changes(page, lambda: page.drag((x, y), ((x + left) / 2, y))) > 0.01
    assert shown("high") == pytest.approx((shown("low") + middle) / 2, rel=0.02)
    page.js("document.getElementById('legend-high').focus()")
    before = shown("high")
    page.key("ArrowUp")
    page.settle()
    assert shown("high") == pytest.approx(before + 0.01 * (before - shown("low")), rel=1e-6)
    page.key("End")
    page.settle()
    assert shown("high") == pytest.approx(values.max(), rel=1e-3)
    page.js("document.getElementById('range-full').click()")
    page.settle()
    assert shown("low") == pytest.approx(values.min(), rel=1e-3)
    page.js("document.getElementById('range-auto').click()")
    page.settle()
    assert abs(shown("low") - numpy.percentile(values, 1)) < 1e-3 * span


def test_threshold(page, animal):
    values, areas = animal.fields["sdf"], animal.areas
    limit = float(numpy.percentile(values, 40))
    page.choose("thin-at", limit)
    page.settle()
    assert page.js("document.getElementById('thin').checked")
    assert "thinner than" in page.js("document.querySelector('#legend canvas').getAttribute('aria-label')")
    text = page.text("thin-result")
    below = values < limit
    assert abs(number(text.replace(",", "")) - below.sum()) <= 0.002 * len(values)
    assert number(text.split("area ")[1]) == pytest.approx(areas[below].sum(), rel=5e-3)
    assert number(text.split("(")[1]) == pytest.approx(100 * areas[below].sum() / areas.sum(), rel=1e-2)
    drawn = drawn_share(settled_view(page))
    page.choose("rest", "hidden")
    assert drawn_share(settled_view(page)) < 0.9 * drawn
    assert changes(page, lambda: page.choose("edges", True)) > 0
    assert changes(page, lambda: page.choose("thin", False)) > 0.02
    before = page.js("document.getElementById('thin-at').value")
    page.choose("thin-slider", float(numpy.percentile(values, 80)))
    assert page.js("document.getElementById('thin-at').value") != before


@pytest.mark.parametrize("element,value,share", [
    ("shading", "smooth", 0.004), ("shading", "plain", 0.02), ("edges", True, 0.02), ("clip", "x", 0.02), ("clip", "y", 0.01),
    ("clip", "z", 0.01), ("clip", "view", 0.01), ("up", "x", 0.02)])
def test_surface_and_clip(page, element, value, share):
    assert changes(page, lambda: page.choose(element, value), 2 if value == "smooth" else 12) > share
    if element == "clip":
        assert changes(page, lambda: page.choose("clip-at", 0.4)) > 0.005
        backs = [settled_view(page)]
        for back in ("grey", "hidden"):
            page.choose("back", back)
            backs.append(settled_view(page))
        assert changes(page, lambda: page.choose("clip-flip", True)) > 0.01
        for back in ("same", "grey", "hidden"):
            page.choose("back", back)
            backs.append(settled_view(page))
        # From one of the two sides the inside is seen.
        for one, other in ((0, 1), (1, 2), (0, 2)):
            assert max(difference(backs[one], backs[other]), difference(backs[3 + one], backs[3 + other])) > 0.002


def test_report(page, animal):
    part = page.js("document.querySelector('#part-0-1 strong').textContent")
    assert int(part) in animal.fields["segment"]
    assert changes(page, lambda: page.js("document.getElementById('part-0-1').click()")) > 0.05
    assert state(page)["part"] == f"0:{part}"
    assert changes(page, lambda: page.js("document.getElementById('part-none').click()")) > 0.02


def test_comparison(open_page, comparison):
    page = open_page(comparison)
    both = settled_view(page)
    assert page.js("document.querySelectorAll('.pane-title').length") == 2
    left, top, width, height = box_of(page, "view")
    halves = lambda p: (p.crop((0, 40, int(width) // 2, int(height) - 40)), p.crop((int(width) // 2, 40, int(width) // 2 * 2, int(height) - 40)))  # noqa: E731
    wide = width > height
    if not wide:
        halves = lambda p: (p.crop((0, 30, int(width), int(height) // 2 - 35)), p.crop((0, 30 + int(height) // 2, int(width), int(height) // 2 * 2 - 35)))  # noqa: E731
    assert difference(*halves(both)) < 0.1
    page.js("document.getElementById('view').focus()")
    page.key("ArrowLeft")
    assert difference(*halves(settled_view(page))) < 0.1
    show = page.js("[...document.getElementById('show').options].map((option) => option.value)")
    assert show == ["all", "0", "1", "1-0"]
    assert changes(page, lambda: page.choose("show", "0")) > 0.05
    assert changes(page, lambda: page.choose("show", "1-0")) > 0.05
    label = page.js("document.querySelector('#legend canvas').getAttribute('aria-label')")
    assert label.startswith("difference of ")
    low, high = re.findall(r"-?[\d.e-]+\d", label)[-2:]
    assert float(low) == pytest.approx(-float(high), rel=1e-3)
    page.key("Enter")
    assert page.text("picked-0-sdf") and page.text("picked-1-sdf")
