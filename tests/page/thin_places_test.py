"""A page with a limit of the thickness: the thin places, in the first view and after a click."""

import numpy
import pytest

from views import box_of, changes, difference, drawn_share, settled_view, state


def alarm_share(picture):
    """Share of the pixels that are red."""
    red, green, blue = (numpy.asarray(picture)[:, :, i].astype(int) for i in range(3))
    return float(((red > green + 50) & (red > blue + 50)).mean())


@pytest.fixture
def page(open_page, cavities):
    return open_page(cavities["cavities"])


def test_first_view_shows_the_hidden_place(page):
    assert alarm_share(settled_view(page)) > 0.005
    assert page.text("verdict-0").startswith("FAIL: 1 wall thinner than 0.8: 0.5 at (")
    assert page.js("document.getElementById('thin').checked && document.getElementById('thin-at').value") == "0.8"
    assert page.js("document.querySelector('#legend canvas').getAttribute('aria-label')").startswith("thinner than 0.8, ")
    assert page.js("document.querySelector('#legend canvas').getAttribute('aria-label')").endswith("; pale: behind a wall")
    # The list is above the controls, the walls in it are links; rings with the values are in the view.
    assert page.js("document.getElementById('thin-places').nextElementSibling.className") == "needs-view"
    assert page.text("thin-0-0") == "0.5"
    assert page.text("marker-0-0") == "0.5"
    assert page.js("document.querySelectorAll('.marker').length") == 1
    assert page.js("document.querySelectorAll('.end:not([hidden])').length") == 0


def test_other_faces(page):
    glass = settled_view(page)
    page.choose("rest", "grey")
    grey = settled_view(page)
    assert page.js("document.querySelector('#legend canvas').getAttribute('aria-label')").endswith(" of the area")
    assert alarm_share(grey) == 0 and drawn_share(grey) > 0.2
    page.choose("rest", "hidden")
    hidden = settled_view(page)
    assert alarm_share(hidden) >= 0.9 * alarm_share(glass) and drawn_share(hidden) < 0.3 * drawn_share(grey)
    page.choose("clip", "y")
    page.choose("rest", "grey")
    page.choose("clip-at", 0.33)
    page.choose("clip-flip", True)
    assert alarm_share(settled_view(page)) > 0.002


def test_a_click_looks_at_the_place(page):
    before = alarm_share(settled_view(page))
    page.js("document.getElementById('thin-0-0').click()")
    assert alarm_share(settled_view(page)) > 1.5 * before
    assert state(page)["face"].startswith("0:")
    marker, (left, top, width, height) = box_of(page, "marker-0-0"), box_of(page, "view")
    assert left + width / 4 < marker[0] < left + width * 3 / 4 and top + height / 4 < marker[1] < top + height * 3 / 4
    page.choose("rest", "grey")  # A click opens the view again.
    page.js("document.getElementById('thin-0-0').click()")
    assert page.js("document.getElementById('rest').value") == "glass"


def test_other_limits_work_by_face(page):
    exact = settled_view(page)
    page.choose("thin-at", 0.4)
    page.settle()
    assert page.text("thin-result").startswith("0 faces below 0.4")
    assert alarm_share(settled_view(page)) == 0
    assert page.js("document.querySelectorAll('.marker').length") == 0
    page.choose("thin-at", 6)
    page.settle()
    # All faces of the two cavities whose least thickness is below 6, of which some are not thinner than 0.8.
    assert int(page.text("thin-result").split(" ")[0]) > 4
    assert alarm_share(settled_view(page)) > 0.01
    page.js("document.getElementById('thin-given').click()")
    assert difference(exact, settled_view(page)) < 0.002
    assert not page.js("document.getElementById('thin-given').checkVisibility()")


def test_a_layer_replaces_the_thin_places(page):
    assert changes(page, lambda: page.choose("layer", "thickness")) > 0.1
    assert not page.js("document.getElementById('thin').checked")
    assert page.js("document.querySelector('#legend canvas').getAttribute('aria-label')").startswith("wall thickness")
    page.choose("thin", True)
    assert alarm_share(settled_view(page)) > 0.005


def test_nothing_thin(open_page, cavities):
    page = open_page(cavities["thick"])
    picture = settled_view(page)
    assert alarm_share(picture) == 0 and drawn_share(picture) > 0.2
    assert page.text("verdict-0").startswith("PASS: no wall thinner than 0.4")
    assert page.js("document.querySelector('#legend canvas').getAttribute('aria-label')").startswith("nowhere thinner than 0.4")


def test_each_mesh_has_its_upright_axis_and_changes_refit_the_view(open_page, cavities):
    page = open_page(cavities["two"])
    assert page.js("document.getElementById('up').value") == "auto"
    data = page.js("JSON.parse(document.getElementById('asdf-vk-page').textContent).meshes.map((mesh) => mesh.up)")
    assert data[0] == "z"
    assert alarm_share(settled_view(page)) > 0.01

    def margins(picture):
        pixels = numpy.asarray(picture).astype(int)
        drawn = abs(pixels - pixels[2, 2]).max(2) > 12
        rows, columns = numpy.flatnonzero(drawn[30:-35].any(1)), numpy.flatnonzero(drawn[30:-35].any(0))
        return (rows[-1] - rows[0]) / (len(pixels) - 65), (columns[-1] - columns[0]) / len(pixels[0])

    page.choose("show", "0")
    assert 0.8 < max(margins(settled_view(page)))
    for up in ("x", "-y", "z"):
        page.choose("up", up)
        assert 0.8 < max(margins(settled_view(page))) <= 1
        assert "zoom" in state(page)


def test_words_of_the_summary_are_whole(page):
    page.settle()
    heights = page.js("""[...document.querySelectorAll('#summary-0 tbody th')].map((cell) => {
        const range = document.createRange();
        range.selectNodeContents(cell);
        return range.getClientRects().length; })""")
    assert heights and max(heights) == 1


def test_sealed_voids_are_listed_and_marked(open_page, cavities):
    page = open_page(cavities["voids"])
    assert page.text("verdict-0").startswith("PASS: no gap closer than 0.4")
    assert page.js("document.getElementById('thin-places').textContent.includes('Sealed voids')")
    assert sorted(page.text(f"thin-0-{i}") for i in range(2)) == ["192", "264"]
    settled_view(page)
    shown = {page.text(f"marker-0-{i}") for i in range(2)} - {""}  # A text that would cover another one is hidden.
    assert shown and shown <= {"void 192", "void 264"}
    page.js("document.getElementById('thin-0-1').click()")
    settled_view(page)
    assert state(page)["face"].startswith("0:")
