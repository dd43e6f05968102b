"""The first frame of the page, its data, and its robustness."""

import pathlib
import re

import pytest

import browser as chromium
from views import box_of, changes, difference, drawn_share, settled_view, view_picture


def test_first_frame(page, animal):
    picture = settled_view(page)
    assert 0.04 < drawn_share(picture) < 0.9
    assert page.js("document.querySelector('#summary-0 tbody').rows.length") > 3
    assert page.js("document.getElementById('fallback').hidden")
    assert "animal.ply" in page.text("details") and "animal.ply" in page.js("document.title")
    assert page.js("document.getElementById('view').getAttribute('aria-label')").startswith("3D view of animal.ply")


def test_size_without_mesh(animal):
    text = animal.path.read_text()
    without = re.sub(r'<script type="application/(json|octet-stream)".*?</script>|data:image/png;base64,[^"]*', "", text,
                     flags=re.S)
    assert len(without) < 60000


def test_format(animal):
    """The reader in docs/page-format.md returns the mesh and its values."""
    text = (pathlib.Path(__file__).resolve().parents[2] / "docs" / "page-format.md").read_text()
    read = {}
    exec(re.search("```python\n(.*?)```", text, re.S)[1].replace('"mesh.html"', repr(str(animal.path))), read)
    faces, vertices, files_faces = read["faces"], read["vertices"], read["face_in_file"]
    assert sorted(files_faces) == list(range(len(animal.faces)))
    assert abs(vertices[faces] - animal.vertices[animal.faces[files_faces]]).max() <= 0.51 * read["mesh"]["step"]
    assert read["sdf"] == pytest.approx(animal.fields["sdf"][files_faces], rel=2 ** -15, nan_ok=True)
    assert (read["values"]["segment"] == animal.fields["segment"][files_faces]).all()
    assert (read["values"]["seed"] == animal.fields["seed"][files_faces]).all()


@pytest.mark.parametrize("part,damage", [
    ('id="array-0">', lambda text: text[:1000]),                        # Deflate ends early.
    ('id="array-1">', lambda text: text[:600] + "!" + text[601:]),      # Not base64.
    ('id="asdf-vk-page">', lambda text: text.replace(',"vertexCount":', '0,"vertexCount":')),
    ('id="asdf-vk-page">', lambda text: text.replace('"vertexCount":', '"vertexCount":1', 1)),
    ('id="asdf-vk-page">', lambda text: text.replace('"corners":', '"corners":9', 1)),
    ('id="asdf-vk-page">', lambda text: text[:-9]),
    ('id="script">', lambda text: text[:5000])])
def test_damaged_data(browser, animal, tmp_path, part, damage):
    text = animal.path.read_text()
    begin = text.index(part) + len(part)
    end = text.index("</script>", begin)
    (tmp_path / "damaged.html").write_text(text[:begin] + damage(text[begin:end]) + text[end:])
    page = browser.page()
    page.open((tmp_path / "damaged.html").as_uri(), state="error")
    message = page.text("message")
    assert "damaged" in message and "write" in message and message.count("\n") == 0
    assert page.messages() == []
    assert page.js("document.querySelector('#fallback img').checkVisibility()")
    page.socket.close()


def test_dark(open_page, animal):
    page = open_page(animal.address, dark=True)
    page.settle()
    assert sum(page.screenshot().getpixel((4, 4))) < 120
    page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "light"}])
    page.settle()
    assert sum(page.screenshot().getpixel((4, 4))) > 700


def test_narrow_window(page):
    page.call("Emulation.setDeviceMetricsOverride", width=390, height=800, deviceScaleFactor=1, mobile=False)
    page.settle()
    assert page.js("document.documentElement.scrollWidth") <= 390
    assert box_of(page, "view")[2] >= 0.7 * 390
    assert 0.02 < drawn_share(view_picture(page))


def test_lost_context(page):
    before = settled_view(page)
    page.js("window.lost = document.getElementById('view').getContext('webgl2').getExtension('WEBGL_lose_context')")
    page.js("window.lost.loseContext()")
    page.wait("document.documentElement.dataset.state === 'lost'")
    assert not page.js("document.getElementById('message').hidden")
    page.js("setTimeout(() => window.lost.restoreContext(), 50)")
    page.wait("document.documentElement.dataset.state === 'ready'")
    assert difference(before, settled_view(page)) == 0
    page.choose("shading", "smooth")
    page.choose("edges", True)
    page.settle()


def test_one_face_without_value(open_page, one_face):
    page = open_page(one_face)
    assert "onerror" in page.text("details") and "onerror" in page.js("document.title") and page.js("document.querySelectorAll('main img').length") <= 1
    assert drawn_share(settled_view(page)) > 0.01
    assert "no face has a value" in page.js("document.querySelector('#legend canvas').getAttribute('aria-label')")
    left, top, width, height = box_of(page, "view")
    page.click(left + width / 2, top + height / 2 + height / 12)
    assert page.text("picked-id") == "0" and page.text("picked-0-sdf") == "no value"
    assert page.js("document.getElementById('threshold').disabled")
    assert changes(page, lambda: page.choose("none", "#00ff00")) > 0.01


def test_without_webgl(animal):
    with chromium.Browser(["--disable-3d-apis"]) as running:
        page = running.page()
        page.open(animal.address, state="nogl")
        assert page.js("document.querySelector('#summary-0 tbody').rows.length") > 3
        assert page.js("document.querySelector('#fallback img').naturalWidth") > 100
        assert page.js("document.querySelector('#fallback').checkVisibility()")
        assert "WebGL 2" in page.text("message")
        assert not page.js("document.getElementById('layer').checkVisibility()")
        assert page.js("[...document.querySelectorAll('#meshes button')].every((b) => b.textContent.startsWith('Show all'))")
        assert page.messages() == [] and page.requests() == []
        page.socket.close()
