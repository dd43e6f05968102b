"""The page that computes, with a fake engine: files, verdict, limit, unit, tabs, progress, errors and saving."""

import json
import time

from views import box_of, drawn_share, settled_view


def drop(page, *names):
    """Drops empty files on the page."""
    page.js(f"""(() => {{
      const dataTransfer = new DataTransfer();
      for (const name of {json.dumps(names)}) dataTransfer.items.add(new File(['x'], name));
      dispatchEvent(new DragEvent('drop', {{ dataTransfer, cancelable: true }}));
    }})()""")


def shown(page):
    page.wait("document.documentElement.dataset.state === 'ready' && document.getElementById('work').hidden")
    page.settle()


def calls(page):
    return page.js("fakeCalls")


def enter(page, element, value):
    page.js(f"(() => {{ const e = document.getElementById('{element}'); e.value = '{value}'; e.dispatchEvent(new Event('change')); }})()")


def test_before_a_file(page):
    assert page.js("document.getElementById('drop').checkVisibility()")
    assert not page.js("document.getElementById('save').checkVisibility() || document.getElementById('tabs').querySelector('button').checkVisibility()")
    assert page.text("headline") == "Check the walls of a part"


def test_a_dropped_file_is_judged(page):
    drop(page, "box.bin", "box.gltf")
    shown(page)
    assert calls(page) == [["open", ["box.gltf", "box.bin"], ""], ["check", 0.8]]
    assert page.text("headline") == "FAIL The thinnest wall is 0.5, the limit 0.8."
    assert drawn_share(settled_view(page)) > 0.05
    assert not page.js("document.getElementById('drop').checkVisibility()")


def test_another_limit_does_not_read_again(page):
    drop(page, "box.stl")
    shown(page)
    page.js("document.getElementById('view').focus()")
    page.key("ArrowLeft")
    page.settle()
    before = settled_view(page)
    enter(page, "limit", "1,5")
    shown(page)
    assert calls(page)[2:] == [["check", 1.5]]
    assert settled_view(page).tobytes() == before.tobytes()  # The view stays.
    enter(page, "limit", "x")
    page.wait("document.getElementById('headline').className === 'error'")
    assert "'x' is no length" in page.text("headline")
    enter(page, "limit", "0.8")
    shown(page)
    page.wait("document.getElementById('headline').className === 'failed'")


def test_a_unit_reads_again(page):
    drop(page, "box.stl")
    shown(page)
    assert page.text("limit-unit") == ""
    enter(page, "unit", "in")
    page.wait("fakeCalls.length === 4")
    shown(page)
    assert calls(page)[2:] == [["open", ["box.stl"], "in"], ["check", "0.8mm"]] and page.text("limit-unit") == "mm"


def test_tabs_compute_on_demand(page):
    drop(page, "box.stl")
    shown(page)
    tabs = page.js("[...document.querySelectorAll('[role=tab]')].filter((tab) => tab.checkVisibility()).map((tab) => tab.textContent)")
    assert tabs == ["Walls", "Diameter", "Parts"]
    page.js("document.getElementById('tab-parts').click()")
    page.wait("document.getElementById('tab-parts').ariaSelected === 'true'")
    assert calls(page)[2:] == [["compute", {"segment": True}]]
    page.js("document.getElementById('tab-diameter').click()")
    assert len(calls(page)) == 3 and page.js("document.getElementById('layer').value") == "sdf"


def test_errors_are_sentences_and_the_page_lives(page):
    for name in ("bad.stl", "bad2.stl"):
        drop(page, name)
        page.wait(f"document.getElementById('headline').textContent === '{name}: the file ends early'")
        assert page.js("document.getElementById('drop').checkVisibility()")
    drop(page, "box.stl")
    shown(page)
    assert page.text("headline").startswith("FAIL ")
    drop(page, "bad.stl")
    page.wait("document.documentElement.dataset.state === 'empty'")
    assert page.text("headline") == "bad.stl: the file ends early" and not page.js("document.getElementById('save').checkVisibility()")


def test_progress_and_cancel(page):
    drop(page, "slow.stl")
    page.wait("!document.getElementById('work').hidden && document.getElementById('work-share').value > 0.1")
    assert page.text("work-name") == "Checking slow.stl"
    page.js("document.getElementById('cancel').click()")
    page.wait("document.getElementById('work').hidden")
    assert page.text("headline") == "Cancelled." and page.js("document.getElementById('drop').checkVisibility()")
    drop(page, "slow.stl")
    page.wait("!document.getElementById('work').hidden")
    drop(page, "box.stl")  # Replaces the running task.
    page.wait("document.documentElement.dataset.state === 'ready'")
    assert calls(page)[-2:] == [["open", ["box.stl"], ""], ["check", 0.8]]


def test_results_are_freed(page):
    drop(page, "box.stl")
    shown(page)
    count = "performance.memory.usedJSHeapSize"
    for _ in range(5):
        enter(page, "limit", "0.8")
        shown(page)
    page.call("HeapProfiler.collectGarbage")
    before = page.js(count)
    for i in range(40):
        enter(page, "limit", f"0.{i + 10}")
        page.wait(f"fakeCalls.at(-1)[1] === 0.{i + 10}")
        shown(page)
    page.call("HeapProfiler.collectGarbage")
    assert page.js(count) < before + 2e6


def test_save(page, tmp_path):
    page.call("Page.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
    drop(page, "box.stl")
    shown(page)
    for suffix in ("ply", "json", "html", "png"):
        page.js(f"document.querySelector('[data-format={suffix}]').click()")
        end = time.monotonic() + 10
        while not list(tmp_path.glob(f"*.{suffix}")) and time.monotonic() < end:
            time.sleep(0.05)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["box.html", "box.json", "box.ply", "wall.png"]
    assert (tmp_path / "box.ply").read_text() == "ply"


def test_phone(page):
    page.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1, mobile=True)
    drop(page, "box.stl")
    shown(page)
    assert page.js("document.documentElement.scrollWidth") == 390
    assert box_of(page, "view")[1] + 250 < 844
    heights = page.js("[...document.querySelectorAll('#tools :is(button, select, input, summary)')].filter((e) => e.checkVisibility()).map((e) => e.getBoundingClientRect().height)")
    assert min(heights) >= 36
