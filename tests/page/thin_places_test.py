"""A page with a limit of the thickness: the verdict, the thin places in the first view, and after a click."""

import numpy
import pytest

from views import box_of, changes, difference, drawn_share, settled_view, state

ALARM = (0xd3, 0x23, 0x1b)


def alarm_share(picture):
    """Share of the pixels that are red. The number of a callout has about 0.0017."""
    red, green, blue = (numpy.asarray(picture)[:, :, i].astype(int) for i in range(3))
    return float(((red > green + 50) & (red > blue + 50)).mean())


def legend(page):
    return page.js("document.querySelector('#legend canvas').getAttribute('aria-label')")


def callouts(page):
    return page.js("[...document.querySelectorAll('.callout')].map((one) => [...one.childNodes].map((node) => node.textContent))")


def value_of(page, index):
    return page.js(f"document.querySelector('#thin-0-{index} strong').textContent")


@pytest.fixture
def page(open_page, cavities):
    return open_page(cavities["cavities"])


def test_first_view_shows_the_hidden_place(page):
    assert alarm_share(settled_view(page)) > 0.005
    assert page.text("headline") == "FAIL The thinnest wall is 0.5, the limit 0.8."
    assert page.js("parseFloat(getComputedStyle(document.getElementById('headline')).fontSize)") >= 28
    assert page.text("details").startswith("1 wall thinner than 0.8 · ") and page.text("details").endswith("cavities.stl")
    assert page.text("verdict-0").startswith("FAIL: 1 wall thinner than 0.8: 0.5 at (")
    assert page.js("document.getElementById('thin').checked && document.getElementById('thin-at').value") == "0.8"
    assert legend(page).startswith("thinner than 0.8, ") and legend(page).endswith("; pale: behind a wall")
    # The rows of the list have the numbers of the callouts.
    assert page.js("document.getElementById('tab-walls').ariaSelected") == "true"
    assert callouts(page) == [["1", "0.5"]]
    assert page.js("document.querySelector('#thin-0-0 b').textContent") == "1" and value_of(page, 0) == "0.5"
    assert page.js("document.querySelectorAll('.end:not([hidden])').length") == 0


def test_visible_thin_faces_have_the_colour_of_the_legend(open_page, cavities):
    page = open_page(cavities["wall"])
    picture = numpy.asarray(settled_view(page)).astype(int)
    assert (abs(picture - ALARM).max(2) <= 1).mean() > 0.01
    # Around the thin face, the grey of the other faces has a reddish halo.
    reddish = (picture[:, :, 0] > picture[:, :, 1] + 15) & (abs(picture - ALARM).max(2) > 30)
    assert reddish.mean() > 0.002


def test_other_faces(page):
    glass = settled_view(page)
    page.choose("rest", "grey")
    grey = settled_view(page)
    assert legend(page).endswith(" of the area")
    assert alarm_share(grey) < 0.003 and drawn_share(grey) > 0.2
    page.choose("rest", "hidden")
    hidden = settled_view(page)
    assert alarm_share(hidden) > 0.6 * alarm_share(glass) and drawn_share(hidden) < 0.3 * drawn_share(grey)
    page.choose("clip", "y")
    page.choose("rest", "grey")
    page.choose("clip-at", 0.33)
    page.choose("clip-flip", True)
    assert alarm_share(settled_view(page)) > 0.002


def test_a_click_looks_at_the_place(page):
    before, elevation = alarm_share(settled_view(page)), page.js("document.querySelectorAll('#overlays circle').length")
    assert elevation == 1 and page.js("document.getElementById('inset').hidden")
    page.js("document.getElementById('thin-0-0').click()")
    assert alarm_share(settled_view(page)) > 1.2 * before
    after = state(page)
    assert after["place"] == "0:0" and "face" not in after
    assert page.js("document.getElementById('thin-0-0').ariaCurrent") == "true"
    # The two ends of the wall are in the middle of the view. 50 times the thickness fills its width.
    ends = numpy.array(page.js("[...document.querySelectorAll('.end[cx]')].map((c) => [Number(c.getAttribute('cx')), Number(c.getAttribute('cy'))])"))
    _, _, width, height = box_of(page, "view")
    assert len(ends) == 2 and abs(ends.mean(0) - [width / 2, height / 2]).max() < 3
    assert 0.25 * width / 50 < numpy.linalg.norm(ends[1] - ends[0]) <= 1.01 * width / 50
    # The inset shows the whole mesh, with the visible part of it.
    inset, frame = box_of(page, "inset"), page.js("""(() => {
        const b = document.querySelector('#inset span').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()""")
    assert inset[2] > 100 and 0.1 * inset[2] < frame[2] < inset[2]
    assert drawn_share(page.screenshot(area=inset.astype(int) + [2, 2, -4, -4])) > 0.2
    page.js("document.getElementById('inset').click()")
    page.settle()
    assert page.js("document.getElementById('inset').hidden")
    page.choose("rest", "grey")  # A click shows hidden places again.
    page.js("document.querySelector('.callout').click()")
    assert page.js("document.getElementById('rest').value") == "glass" and state(page)["place"] == "0:0"


def test_other_limits_work_by_face(page):
    exact = settled_view(page)
    page.choose("thin-at", 0.4)
    page.settle()
    assert page.text("thin-result").startswith("0 faces below 0.4")
    assert alarm_share(settled_view(page)) == 0
    assert callouts(page) == []
    page.choose("thin-at", 6)
    page.settle()
    # All faces of the two cavities whose least thickness is below 6, of which some are not thinner than 0.8.
    assert int(page.text("thin-result").split(" ")[0]) > 4
    assert alarm_share(settled_view(page)) > 0.01
    page.js("document.getElementById('thin-given').click()")
    assert difference(exact, settled_view(page)) < 0.002
    assert page.js("document.getElementById('thin-given').hidden")


def test_a_layer_replaces_the_thin_places(page):
    assert changes(page, lambda: page.choose("layer", "thickness")) > 0.1
    assert not page.js("document.getElementById('thin').checked")
    assert legend(page).startswith("wall thickness")
    page.choose("thin", True)
    assert alarm_share(settled_view(page)) > 0.005


def test_nothing_thin_shows_the_least_wall(open_page, cavities):
    page = open_page(cavities["thick"])
    picture = settled_view(page)
    assert alarm_share(picture) == 0 and drawn_share(picture) > 0.2
    assert page.text("headline") == "PASS The thinnest wall is 0.5, the limit 0.4."
    assert page.text("verdict-0").startswith("PASS: no wall thinner than 0.4")
    assert legend(page).startswith("nowhere thinner than 0.4")
    assert callouts(page) == [["1", "0.5"]]
    assert changes(page, lambda: page.js("document.getElementById('thin-0--1').click()")) > 0.05
    assert state(page)["place"] == "0:-1" and page.js("document.querySelectorAll('.end[cx]').length") == 2


def test_edges_that_do_not_count(open_page, cavities):
    page = open_page(cavities["wedge"])
    picture = numpy.asarray(settled_view(page)).astype(int)
    assert page.text("headline").startswith("PASS ")
    assert (abs(picture - ALARM).max(2) <= 1).mean() == 0
    amber = (picture[:, :, 0] > picture[:, :, 2] + 80) & (picture[:, :, 1] > picture[:, :, 2] + 40)
    assert amber.mean() > 0.001
    assert page.text("walls-list").count("not counted") == 1


def test_each_mesh_has_its_upright_axis_and_changes_refit_the_view(open_page, cavities):
    page = open_page(cavities["two"])
    assert page.text("headline").startswith("FAIL ")
    assert page.js("document.getElementById('up').value") == "auto"
    data = page.js("JSON.parse(document.getElementById('asdf-vk-page').textContent).meshes.map((mesh) => mesh.up)")
    assert data[0] == "z"
    assert alarm_share(settled_view(page)) > 0.01

    def margins():
        page.js("document.getElementById('overlays').style.visibility = 'hidden'")
        pixels = numpy.asarray(settled_view(page)).astype(int)
        drawn = abs(pixels - pixels[2, 2]).max(2) > 12
        rows, columns = numpy.flatnonzero(drawn.any(1)), numpy.flatnonzero(drawn.any(0))
        return (rows[-1] - rows[0]) / (len(pixels) - 40), (columns[-1] - columns[0]) / (len(pixels[0]) - 252)

    page.choose("show", "0")
    assert 0.8 < max(margins()) < 1.1  # With the halo of the thin places.
    for up in ("x", "-y", "z"):
        page.choose("up", up)
        assert 0.8 < max(margins()) < 1.1
        assert "zoom" in state(page)


def test_words_of_the_summary_are_whole(page):
    page.js("document.getElementById('tab-more').click()")
    page.settle()
    heights = page.js("""[...document.querySelectorAll('#summary-0 tbody th')].map((cell) => {
        const range = document.createRange();
        range.selectNodeContents(cell);
        return range.getClientRects().length; })""")
    assert heights and max(heights) == 1


def test_sealed_voids_are_listed_and_marked(open_page, cavities):
    page = open_page(cavities["voids"])
    assert page.text("verdict-0").startswith("PASS: no gap closer than 0.4")
    assert "Sealed voids" in page.text("meshes")
    rows = page.js("[...document.querySelectorAll('#walls-list small')].map((row) => row.textContent)")
    assert {"sealed void, volume 192", "sealed void, volume 264"} <= set(rows)
    settled_view(page)
    assert {"void 192", "void 264"} <= {text for _, text in callouts(page)}
    page.js("document.getElementById('thin-0-1').click()")
    settled_view(page)
    assert state(page)["place"] == "0:1"
