"""The tabs of the page, the headline without a limit, and the page on the width of a phone."""

import numpy

from views import box_of, changes, difference, settled_view, state


def selected(page):
    return page.js("[...document.querySelectorAll('[role=tab]')].filter((tab) => tab.ariaSelected === 'true').map((tab) => tab.id)")


def visible_tabs(page):
    return page.js("[...document.querySelectorAll('[role=tab]')].filter((tab) => tab.checkVisibility()).map((tab) => tab.textContent)")


def test_parts_are_first_if_they_were_computed(open_page, parts):
    page = open_page(parts)
    page.settle()
    assert selected(page) == ["tab-parts"] and visible_tabs(page) == ["Diameter", "Parts"]
    assert page.text("headline").endswith(" parts.") and page.text("details").endswith("animal.ply")
    assert page.js("document.getElementById('layer').value") == "segment"
    assert page.js("JSON.parse(document.getElementById('asdf-vk-page').textContent).meshes[0].up") == "z"


def test_tabs_select_the_layer(page):
    page.settle()
    assert visible_tabs(page) == ["Walls", "Diameter", "Parts"] and selected(page) == ["tab-diameter"]
    for name, layer in (("parts", "segment"), ("walls", "thickness"), ("diameter", "sdf")):
        assert changes(page, lambda name=name: page.js(f"document.getElementById('tab-{name}').click()")) > 0.05
        assert selected(page) == [f"tab-{name}"] and page.js("document.getElementById('layer').value") == layer
        panels = page.js("[...document.querySelectorAll('[role=tabpanel]')].filter((one) => one.checkVisibility()).map((one) => one.id)")
        assert panels == [f"panel-{name}"]
    page.choose("layer", "segment")
    assert selected(page) == ["tab-parts"]
    page.js("document.getElementById('tab-parts').focus()")
    page.key("ArrowLeft")
    assert selected(page) == ["tab-diameter"] and page.js("document.activeElement.id") == "tab-diameter"


def test_everything_else_is_behind_one_button(page):
    before, view = settled_view(page), box_of(page, "view")
    visible = lambda: page.js("[...document.querySelectorAll('input, select, table')].filter((e) => e.checkVisibility()).length")  # noqa: E731
    assert visible() == 0
    page.js("document.getElementById('tab-more').click()")
    assert visible() > 15 and page.js("document.getElementById('tab-more').ariaExpanded") == "true"
    assert (box_of(page, "view") == view).all() and difference(before, settled_view(page)) == 0
    page.js("document.getElementById('tab-more').click()")
    assert visible() == 0


def test_a_click_on_a_face_shows_its_value(page):
    left, top, width, height = box_of(page, "view")
    page.click(left + width / 2, top + height / 2)
    page.settle()
    value = page.text("value-0")
    assert value and page.text("picked-0-sdf").startswith(value)
    page.js("document.getElementById('view').focus()")
    page.key("Escape")
    page.settle()
    assert page.text("value-0") is None and "face" not in state(page)


def test_phone(open_page, cavities, animal):
    for address in (cavities["cavities"], animal.address):
        page = open_page(address)
        page.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1, mobile=True)
        page.settle()
        assert page.js("document.documentElement.scrollWidth") == 390
        headline, view, tabs = (box_of(page, name) for name in ("headline", "view", "tabs"))
        assert page.js("parseFloat(getComputedStyle(document.getElementById('headline')).fontSize)") >= 20
        assert headline[1] + headline[3] <= view[1] and view[2] == 390 and view[3] > 0.45 * 844
        assert tabs[1] + tabs[3] < 844 - 48  # A row of the list is visible.
        sizes = page.js("""[...document.querySelectorAll('#tabs button, .place')].filter((e) => e.checkVisibility())
            .map((e) => e.getBoundingClientRect().height)""")
        assert min(sizes) >= 44
        callouts = page.js("[...document.querySelectorAll('.callout')].map((c) => [c.getBoundingClientRect().left, c.getBoundingClientRect().right])")
        assert (numpy.array(callouts or [[0, 390]]) >= 0).all() and (numpy.array(callouts or [[0, 390]]) <= 390).all()
