"""asdf-vk.html with a fake engine, and a browser that opens it. Environment: as for tests/page."""

import json
import os
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "page"))
SKIPPED = 77  # Exit code, as in tests/CMakeLists.txt.
try:
    import browser as chromium
    from meshes import write_stl
except ImportError as error:
    pytest.exit(f"skipped: {error}; scripts/install-packages test installs it", SKIPPED)
if chromium.program() is None:
    pytest.exit("skipped: Chromium is missing; scripts/install-packages test installs it", SKIPPED)


def payload(page):
    """The results of a page of the program, as an engine returns them."""
    text = page.read_text()
    data = re.search('id="asdf-vk-page">(.*?)</script>', text, re.S)[1]
    return {"data": json.loads(data), "arrays": re.findall(r'id="array-\d+">(.*?)</script>', text, re.S)}


@pytest.fixture(scope="session")
def address(tmp_path_factory):
    folder = tmp_path_factory.mktemp("web")
    write_stl(folder / "wall.stl", [((0, 0, 0), (20, 10, 6)), ((6, 3, 0.5), (14, 7, 5))])
    program = os.environ["ASDF_VK_PROGRAM"]
    for name, options in (("walls", ()), ("all", ("--measure", "both", "--segment"))):
        subprocess.run([program, "wall.stl", "--quiet", "-o", f"{name}.html", "--thinner-than", "0.8", *options], cwd=folder, check=True)
        (folder / f"{name}.json").write_text(json.dumps(payload(folder / f"{name}.html")))
    subprocess.run(["cmake", f"-DPAGE={ROOT}/src/page/browser", f"-DWEB={ROOT}/src/web/browser",
                    f"-DENGINE={ROOT}/tests/web/fake_engine.js", f"-DOUTPUT={folder}/template.html", "-P",
                    ROOT / "src/page/bundle.cmake"], check=True)
    subprocess.run([sys.executable, ROOT / "src/web/pack.py", "template.html", "asdf-vk.html", "fake-walls=walls.json", "fake-all=all.json"],
                   cwd=folder, check=True)
    return (folder / "asdf-vk.html").as_uri()


@pytest.fixture(scope="session")
def browser():
    with chromium.Browser() as running:
        yield running


@pytest.fixture
def page(browser, address):
    page = browser.page(size=(1000, 700))
    page.open(address, state="empty")
    yield page
    messages, requests = page.messages(), page.requests()
    stored = page.js("Object.keys(localStorage).length + Object.keys(sessionStorage).length + document.cookie.length")
    page.call("Page.close")
    page.socket.close()
    assert messages == [] and requests == [] and stored == 0
