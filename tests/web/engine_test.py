"""The built asdf-vk.html, with the real engine. Environment: ASDF_VK_WEB_PAGE is its path; ASDF_VK_HOSTILE_DIRS are folders
with further hostile files, separated by colons."""

import base64
import json
import os
import pathlib
import subprocess

import pytest

from meshes import write_stl

PAGE = os.environ.get("ASDF_VK_WEB_PAGE")
pytestmark = pytest.mark.skipif(not PAGE, reason="ASDF_VK_WEB_PAGE is not set; scripts/web builds the page")
KEYS = "['ready', 'empty'].includes(document.documentElement.dataset.state) && document.getElementById('work').hidden"
MESH_BYTES = 2 ** 22  # Larger files are not dropped.

TRIANGLE = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n" \
           b"property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
HOSTILE = {
    "empty.stl": b"", "zeros.stl": bytes(200), "counts.stl": bytes(80) + b"\xff\xff\xff\xff", "cut.ply": TRIANGLE,
    "index.ply": TRIANGLE + b"3 0 1 9\n", "negative.ply": TRIANGLE + b"3 0 1 -1\n", "text.obj": b"v 0 0 0\nf 1 2 3\n",
    "huge.off": b"OFF\n4000000000 4000000000 0\n", "no.3mf": b"PK\x03\x04" + bytes(60), "no.glb": b"glTF" + bytes(20),
    "lonely.gltf": b'{"asset":{"version":"2.0"},"buffers":[{"uri":"lonely.bin","byteLength":12}]}', "step.stl": b"ISO-10303-21;\n",
    "deep.gltf": b"[" * 100000, "name <img src=x onerror=document.title='injected'>.stl": b"solid x\n",
}


def drop(page, files):
    """files: names and bytes."""
    page.js(f"""(() => {{
      document.getElementById('headline').textContent = '';
      const dataTransfer = new DataTransfer();
      for (const [name, text] of {json.dumps([(name, base64.b64encode(data).decode()) for name, data in files])})
        dataTransfer.items.add(new File([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))], name));
      dispatchEvent(new DragEvent('drop', {{ dataTransfer, cancelable: true }}));
    }})()""")
    page.wait(f"{KEYS} && !['', 'Cancelled.'].includes(document.getElementById('headline').textContent)"
              " && !document.getElementById('headline').textContent.endsWith(' ...')", 60)
    return page.text("headline")


@pytest.fixture
def built(browser):
    page = browser.page(size=(1000, 700))
    page.open(pathlib.Path(PAGE).resolve().as_uri(), state="empty", seconds=60)
    yield page
    messages, requests = page.messages(), page.requests()
    page.call("Page.close")
    page.socket.close()
    assert messages == [] and requests == []


def sentence_of_program(folder, name):
    """The sentence of the error of the program; None if it judges the file."""
    run = subprocess.run([os.environ["ASDF_VK_PROGRAM"], f"./{name}", "--backend", "cpu", "--fail-if-thinner", "0.8"], cwd=folder,
                         capture_output=True, text=True)
    lines = [line for line in run.stderr.splitlines() if line.startswith("asdf-vk: error: ")]
    return lines[0].removeprefix("asdf-vk: error: ").removeprefix("./") if lines and run.returncode not in (5, 6) else None


def test_size():
    assert os.path.getsize(PAGE) < 2 * 2 ** 20


def test_a_part(built, tmp_path):
    write_stl(tmp_path / "wall.stl", [((0, 0, 0), (20, 10, 6)), ((6, 3, 0.5), (14, 7, 5))])
    data = (tmp_path / "wall.stl").read_bytes()
    assert drop(built, [("wall.stl", data)]) == "FAIL The thinnest wall is 0.5, the limit 0.8."
    built.js("document.getElementById('limit').value = '0.4'; document.getElementById('limit').dispatchEvent(new Event('change'))")
    built.wait("document.getElementById('headline').className === 'passed'", 60)
    assert built.text("headline") == "PASS The thinnest wall is 0.5, the limit 0.4."
    built.js("document.getElementById('tab-parts').click()")
    built.wait("document.getElementById('tab-parts').ariaSelected === 'true'", 60)
    assert built.text("headline").startswith("PASS ")


def test_hostile_files(built, tmp_path):
    """Each gives the sentence of the program, one after another on one page."""
    for name, data in HOSTILE.items():
        (tmp_path / name.replace("/", "")).write_bytes(data)
    folders = [pathlib.Path(folder) for folder in os.environ.get("ASDF_VK_HOSTILE_DIRS", "").split(":") if folder]
    wrong = []
    for path in [path for folder in [tmp_path, *folders] for path in sorted(folder.iterdir())]:
        if not path.is_file() or path.stat().st_size > MESH_BYTES:
            continue
        headline, wanted = drop(built, [(path.name, path.read_bytes())]), sentence_of_program(path.parent, path.name)
        if headline != wanted if wanted else headline.split()[0] not in ("PASS", "FAIL", "NOT"):
            wrong.append((path.name, headline, wanted))
    assert wrong == []
    write_stl(tmp_path / "box.stl", [((0, 0, 0), (20, 10, 6))])
    assert drop(built, [("box.stl", (tmp_path / "box.stl").read_bytes())]).startswith("PASS ")
    assert built.js("document.title") == "Check the walls of a part"
