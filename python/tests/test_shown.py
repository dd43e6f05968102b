from __future__ import annotations

import base64
import json
import pickle
import re
import struct
import subprocess
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import asdf_vk
from shapes import cube, dumbbell, sphere


def meshes_of(page: Path) -> list[dict[str, Any]]:
    found = re.search(r'<script type="application/json" id="asdf-vk-page">(.*?)</script>', page.read_text(), re.DOTALL)
    assert found is not None
    meshes: list[dict[str, Any]] = json.loads(found[1])["meshes"]
    return meshes


def numbers(page: Path, array: int, count: int) -> Any:
    """Returns an array of a page (docs/page-format.md)."""
    found = re.search(f'<script type="[^"]*" id="array-{array}">(.*?)</script>', page.read_text(), re.DOTALL)
    assert found is not None
    planes = np.frombuffer(zlib.decompress(base64.b64decode(found[1])), "u1").reshape(-1, count)
    stored = np.zeros(count, "u4")
    for i, plane in enumerate(planes):
        stored |= plane.astype("u4") << np.uint32(8 * i)
    return np.cumsum((stored >> 1).astype("i4") ^ -(stored & 1).astype("i4"), dtype="i4").astype("u4")


def pixels(picture: Path) -> Any:
    image = pytest.importorskip("PIL.Image")
    return np.asarray(image.open(picture)).astype(int)


def test_a_page_shows_several_results(tmp_path: Path, reference: asdf_vk.Session) -> None:
    mesh = dumbbell()
    page = tmp_path / "bell.html"
    info = asdf_vk.compute(*mesh, seeds=0.2, segment="parts", session=reference)
    height = mesh[0][mesh[1]].mean(axis=1)[:, 2]
    asdf_vk.write(page, mesh, info, {"height": height, "axis": np.zeros((len(height), 3))}, labels=["coarse <", "own"])
    first, second = meshes_of(page)
    assert (first["label"], second["label"], first["name"]) == ("coarse <", "own", "bell")
    names = ["segment", "sdf", "seed", "error", "boundary_stability"]
    assert [field["name"] for field in first["fields"]] == names
    assert first["fields"][1]["title"] == "shape diameter" and first["fields"][1]["unit"] == "mesh units"
    assert [field["name"] for field in second["fields"]] == ["height"]
    assert len(first["segments"]) == info.segment_count and first["errorSentence"]
    assert second["summary"] == [{"title": "Mesh", "value": f"{len(height):,} faces"}] and not second["errorSentence"]
    faces = numbers(page, second["arrays"]["faces"], second["faceCount"])
    shown = (numbers(page, second["fields"][0]["array"], second["faceCount"]) << 9).view("f4")
    np.testing.assert_allclose(shown, height[faces], rtol=1e-4, atol=1e-30)
    assert page.read_text().count("data:image/png;base64,") == 2  # The page has a picture for browsers without WebGL.
    asdf_vk.write(page, mesh, info)
    assert meshes_of(page)[0]["label"] == "bell"
    odd = tmp_path / "b\udc80.html"  # A file name that is not valid UTF-8.
    asdf_vk.write(odd, mesh, info)
    assert meshes_of(odd)[0]["label"] == "b\ufffd"


def test_a_picture_shows_a_field(tmp_path: Path, reference: asdf_vk.Session) -> None:
    mesh = sphere(2)
    info = asdf_vk.compute(*mesh, session=reference)
    calls: list[tuple[str, dict[str, Any]]] = [("a.png", {}), ("b.png", {"picture_of": "seed"}), ("c", {"format": "png"})]
    for name, arguments in calls:
        asdf_vk.write(tmp_path / name, mesh, info, **arguments)
    pictures = [(tmp_path / name).read_bytes() for name in ("a.png", "b.png", "c")]
    for picture in pictures:
        assert picture.startswith(b"\x89PNG") and struct.unpack(">II", picture[16:24]) == (1200, 900)
    assert pictures[0] == pictures[2] != pictures[1]


@pytest.mark.parametrize("options", [{}, {"thinner_than": 0.5}, {"segment": "parts"}])
def test_the_picture_is_that_of_the_program(tmp_path: Path, program: Path, options: dict[str, Any]) -> None:
    mesh = dumbbell()
    asdf_vk.write(tmp_path / "x.ply", mesh)
    flags = [text for name, value in options.items() for text in ("--" + name.replace("_", "-"), str(value))]
    subprocess.run([program, tmp_path / "x.ply", "-o", tmp_path / "y.ply", "--backend", "cpu", "--quiet", "--picture",
                    tmp_path / "theirs.png", *flags], check=True)  # fmt: skip
    info = asdf_vk.compute(*mesh, backend="cpu", **options)
    asdf_vk.write(tmp_path / "ours.png", asdf_vk.read_mesh(tmp_path / "x.ply"), info)
    ours, theirs = tmp_path / "ours.png", tmp_path / "theirs.png"
    if options:
        assert ours.read_bytes() == theirs.read_bytes()
    else:  # Here, colours show values. Those of `info` are float32, so that a colour can be rounded differently.
        assert np.abs(pixels(ours) - pixels(theirs)).max() <= 1


def test_a_page_is_that_of_the_program(tmp_path: Path, program: Path) -> None:
    mesh = cube()
    asdf_vk.write(tmp_path / "x.ply", mesh)
    subprocess.run([program, tmp_path / "x.ply", "-o", tmp_path / "theirs.html", "--backend", "reference", "--quiet",
                    "--measure", "both", "--thinner-than", "3"], check=True)  # fmt: skip
    info = asdf_vk.compute(*mesh, measure="both", thinner_than=3, backend="reference")
    asdf_vk.write(tmp_path / "ours.html", mesh, info)
    theirs, ours = (meshes_of(tmp_path / f"{name}.html")[0] for name in ("theirs", "ours"))
    asdf_vk.write(tmp_path / "ours.html", mesh, pickle.loads(pickle.dumps(info)))
    assert meshes_of(tmp_path / "ours.html")[0] == ours

    def spelled(value: str) -> str:
        return value.replace("; --json has all", "")

    def rows(page: dict[str, Any]) -> list[tuple[str, str]]:
        return [(row["title"], spelled(row["value"])) for row in page["summary"] if row["title"] not in ("Time", "Rate")]

    assert rows(ours) == rows(theirs)
    assert info.thin.all() and not asdf_vk.compute(*mesh, measure="thickness", backend="reference").thin.any()
    assert ours["thin"]["regions"]
    for key in ("thin", "errorSentence", "segments", "up", "view", "warnings", "defects"):
        assert ours[key] == theirs[key], key


@pytest.mark.parametrize("name", ["x.glb", "x.obj", "x.ply", "x.vtu", "x.npz"])
def test_data_of_a_result(tmp_path: Path, name: str, reference: asdf_vk.Session) -> None:
    mesh = sphere(1)
    info = asdf_vk.compute(*mesh, per="vertex", session=reference)
    asdf_vk.write(tmp_path / name, mesh, info)
    whole = (tmp_path / name).read_bytes()
    asdf_vk.write(tmp_path / name, mesh, info.fields, vertex_fields=info.vertex_fields)
    assert (tmp_path / name).read_bytes() == whole


def test_a_report_in_a_notebook(reference: asdf_vk.Session) -> None:
    info = asdf_vk.compute(*dumbbell(), measure="both", thinner_than=0.1, session=reference)
    table = info._repr_html_()
    assert info.thickness is not None and info.thickness.verdict is not None
    for text in ("<table>", "5,120 faces", "<th>Diameter</th>", "<th>Thickness</th>", info.thickness.sentence):
        assert text in table


def test_what_cannot_be_shown(tmp_path: Path, reference: asdf_vk.Session) -> None:
    mesh = cube()
    values = {"sdf": np.ones(12)}
    wrong: list[tuple[str, tuple[Any, ...], dict[str, Any], str]] = [
        ("x.html", (), {}, "nothing to show"),
        ("x.png", ({},), {}, "nothing to show"),
        ("x.html", ({"axis": np.zeros((12, 3))},), {}, "nothing to show"),
        ("x.html", ({"sdf": np.ones(3)},), {}, "3 entries"),
        ("x.html", ({"sdf": np.full(12, 1e300)},), {}, "sdf"),
        ("x.html", (values, values), {"labels": ["one"]}, "not 2 printable strings"),
        ("x.html", (values,), {"labels": "x"}, "not 1 printable strings"),
        ("x.html", (values,), {"labels": 5}, "not 1 printable strings"),
        ("x.html", (values,), {"labels": ["\udc80"]}, "not 1 printable strings"),
        ("x.html", (values,), {"vertex_fields": {"a": np.ones(8)}}, "per face"),
        ("x.png", (values,), {"vertex_fields": {"a": np.ones(8)}}, "per face"),
        ("x.html", (values,), {"picture_of": "sdf"}, "drop it"),
        ("x.ply", (values,), {"picture_of": "sdf"}, "drop it"),
        ("x.png", (values, values), {}, r"a page \(.html\) shows several"),
        ("x.ply", (values, values), {}, r"a page \(.html\) shows several"),
        ("x.ply", (values,), {"labels": ["x"]}, "drop them"),
        ("x.html", (values,), {"ascii": True}, "for PLY only"),
        ("x.glb", (values,), {"ascii": True}, "for PLY only"),
        ("x.png", (values,), {"picture_of": "thickness"}, "thickness"),
        ("x.png", (values,), {"picture_of": 3}, "not the name"),
        ("missing/x.png", (values,), {}, "missing"),
        ("missing/x.html", (values,), {}, "missing"),
    ]
    for name, results, options, message in wrong:
        with pytest.raises(asdf_vk.Error, match=message):
            asdf_vk.write(tmp_path / name, mesh, *results, **options)
    assert list(tmp_path.iterdir()) == []


def test_a_report_turns_into_json() -> None:
    info = asdf_vk.compute(*cube(), thinner_than=1.5)
    report = json.loads(json.dumps(info.to_dict(), allow_nan=False))
    assert report["face_count"] == 12 and report["estimated_error"] is None
    assert report["thickness"]["verdict"] == "failed"
    (finding,) = report["findings"]
    assert finding["kind"] == "thinWall" and finding["level"] == "failure" and finding["limit"] == 1.5
    assert len(finding["place"]) == 3 and "1.5" in finding["remedy"]
    assert set(report) == {name for name in vars(info) if name not in {"fields", "vertex_fields", "reversed_faces"}} - {
        "_shown"
    }
