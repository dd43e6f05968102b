"""Pages that the program writes, and a browser that opens them. Environment: ASDF_VK_PROGRAM, ASDF_VK_GENERATE."""

import os
import subprocess
import sys

import pytest

sys.path.insert(0, os.path.dirname(__file__))
SKIPPED = 77  # Exit code, as in tests/CMakeLists.txt.
try:
    import numpy
    import browser as chromium
    from meshes import Mesh, write_ply, write_stl
except ImportError as error:
    pytest.exit(f"skipped: {error}; scripts/install-packages test installs it", SKIPPED)
if chromium.program() is None:
    pytest.exit("skipped: Chromium is missing; scripts/install-packages test installs it", SKIPPED)

FIELDS = "sdf,seed,error,segment,thickness"
INJECTION = "<img src=x onerror=document.title='injected'>.ply"


class Files:
    """A folder with meshes and their pages."""

    def __init__(self, folder):
        self.folder = folder
        self.program = os.environ["ASDF_VK_PROGRAM"]
        subprocess.run([os.environ["ASDF_VK_GENERATE"], "animal", "--faces", "20000", "-o", folder / "animal.ply"],
                       check=True, capture_output=True)

    def run(self, *arguments):
        command = [self.program, *map(str, arguments), "--quiet"]
        result = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
        assert result.returncode == 0, f"{command}: {result.stderr}"

    def address(self, name):
        return (self.folder / name).as_uri()


@pytest.fixture(scope="session")
def files(tmp_path_factory):
    return Files(tmp_path_factory.mktemp("pages"))


@pytest.fixture(scope="session")
def animal(files):
    """The mesh, its values by face, and the address of its page."""
    options = ("--fields", FIELDS, "--seeds", "10%", "--measure", "thickness", "--segment")
    files.run("animal.ply", "-o", "animal.html", *options)
    files.run("animal.ply", "-o", "animal.npz", *options)
    mesh = Mesh(files.folder / "animal.ply")
    mesh.fields = dict(numpy.load(files.folder / "animal.npz"))
    mesh.address = files.address("animal.html")
    mesh.path = files.folder / "animal.html"
    return mesh


@pytest.fixture(scope="session")
def comparison(files):
    """Two results of nearly one mesh: a point of the second one is moved."""
    mesh = Mesh(files.folder / "animal.ply")
    moved = mesh.vertices.copy()
    centre = (moved.min(0) + moved.max(0)) / 2
    moved[numpy.argmin(((moved - centre) ** 2).sum(1))] += 0.05
    write_ply(files.folder / "moved.ply", moved, mesh.faces)
    files.run("animal.ply", "moved.ply", "-o", "compare.html")
    return files.address("compare.html")


@pytest.fixture(scope="session")
def cavities(files):
    """A box of 40 x 30 x 20 with two cavities inside, 0.5 apart: no thin place is visible from outside."""
    write_stl(files.folder / "cavities.stl", [((0, 0, 0), (40, 30, 20)), ((10, 8, 3), (14, 12, 15)), ((14.5, 8, 3), (20, 12, 15))])
    files.run("cavities.stl", "-o", "cavities.html", "--thinner-than", 0.8)
    files.run("cavities.stl", "-o", "thick.html", "--thinner-than", 0.4)
    files.run("cavities.stl", "-o", "voids.html", "--closer-than", 0.4)
    # A plate of 0.5 on a block, and a wedge.
    write_stl(files.folder / "wall.stl", [((0, 0, 0), (20, 10, 6)), ((6, 3, 0.5), (14, 7, 5))])
    files.run("wall.stl", "-o", "wall.html", "--thinner-than", 0.8)
    write_ply(files.folder / "wedge.ply", numpy.array([[0, 0, 0], [20, 0, 0], [20, 0, 18], [0, 20, 0], [20, 20, 0], [20, 20, 18]], "f4"),
              numpy.array([[0, 1, 2], [3, 5, 4], [0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [0, 2, 5], [0, 5, 3]], "i4"))
    files.run("wedge.ply", "-o", "wedge.html", "--thinner-than", 0.8)
    write_ply(files.folder / "plate.ply", numpy.array([[0, 0, 0], [9, 0, 0], [9, 9, 0], [0, 9, 0], [4, 4, 0.5]], "f4"),
              numpy.array([[0, 3, 2], [0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]], "i4"))
    files.run("cavities.stl", "plate.ply", "-o", "two.html", "--thinner-than", 0.8)
    return {name: files.address(f"{name}.html") for name in ("cavities", "thick", "voids", "wall", "wedge", "two")}


@pytest.fixture(scope="session")
def parts(files):
    files.run("animal.ply", "-o", "parts.html", "--segment", "--seeds", "10%")
    return files.address("parts.html")


@pytest.fixture(scope="session")
def one_face(files):
    """A triangle that has no value, in a file whose name is markup."""
    write_ply(files.folder / INJECTION, numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "f4"), numpy.array([[0, 1, 2]], "i4"))
    files.run(INJECTION, "-o", "one.html")
    return files.address("one.html")


@pytest.fixture(scope="session")
def browser():
    with chromium.Browser() as running:
        yield running


@pytest.fixture
def open_page(browser):
    """Opens pages; at the end, the console was silent and no request had left the page."""
    opened = []

    def open_(address, **settings):
        page = browser.page(size=(900, 560), **settings)
        opened.append(page)
        page.open(address)
        return page

    yield open_
    for page in opened:
        messages, requests = page.messages(), page.requests()
        page.call("Page.close")
        page.socket.close()
        assert messages == []
        assert requests == []


@pytest.fixture
def page(open_page, animal):
    return open_page(animal.address)
