"""Verifies reports of the program on parts of known truth, and shows that the verifier refuses wrong reports."""

from __future__ import annotations

import copy
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import mesh_files
import search
import verify_report

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import kept_json

PROGRAM, GENERATOR = os.environ["ASDF_VK_PROGRAM"], os.environ["ASDF_VK_GENERATE"]
SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/verify-report"
# Numbers of points of the search: less than for a user, so that the tests take seconds.
search.GREATEST_COUNT, search.TRIED_PER_CLUSTER = 3_000, 12
# Fine meshes, on which brute force takes seconds.
LEFT_OUT = {"wall-plate-refined.ply", "wall-hollow-box.ply", "wall-round-cup.ply", "wall-sharp-thread.ply",
            "gap-groove-15.5-refined.ply", "gap-groove-18.5-refined.ply", "gap-balls.ply", "edge-wedge-18-refined.ply",
            "edge-wedge-16-refined.ply", "edge-countersink.ply", "edge-letters.ply", "gap-pin-64.ply"}
EACH = 6  # A run verifies a sixth of the files; ASDF_VK_VERIFY_ALL=1 verifies all.


def report_of(mesh: pathlib.Path, *options: str) -> dict:
    output = mesh.with_suffix(".npz")
    done = subprocess.run([PROGRAM, mesh, *options, "--json", "--quiet", "--backend", "reference", "-o", output],
                          capture_output=True, text=True, check=False)
    kept_json.keep(done.stdout)
    return json.loads(done.stdout)


def wrong_claims(mesh: pathlib.Path, report: dict) -> str:
    return "; ".join(verify_report.verify(mesh_files.read_mesh(mesh), report).wrong)


class VerifyTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name) / "corpus"
        subprocess.run([GENERATOR, "--corpus", cls.folder], check=True, capture_output=True)
        cls.holding: dict[int, dict] = {}  # Reports that hold.
        cls.rows = json.loads((cls.folder / "truth.json").read_text())["cases"]

    def report(self, name: str, limit: float, check: str = "thinner") -> tuple[pathlib.Path, dict]:
        mesh = self.folder / name
        return mesh, report_of(mesh, f"--{check}-than", repr(limit))

    def test_claims_on_parts_of_known_truth_hold(self) -> None:
        """The last row of each file: the limit is above its least wall or gap."""
        last = {row["file"]: row for row in self.rows if row["check"] in ("thinner", "closer")}
        for index, (name, row) in enumerate(last.items()):
            if name in LEFT_OUT or (index % EACH and "ASDF_VK_VERIFY_ALL" not in os.environ):
                continue
            with self.subTest(file=name, limit=row["limit"]):
                mesh, report = self.report(name, row["limit"], row["check"])
                self.assertEqual(wrong_claims(mesh, report), "")

    def refused(self, mesh: pathlib.Path, report: dict, reason: str, change) -> None:
        """The report holds; after the change, it is refused for this reason."""
        changed = copy.deepcopy(report)
        change(changed["thickness"] or changed["gap"])
        if id(report) not in self.holding:
            self.assertEqual(wrong_claims(mesh, report), "")
            self.holding[id(report)] = report
        with self.subTest(reason=reason):
            self.assertRegex(wrong_claims(mesh, changed), reason)

    def test_changed_places_are_refused(self) -> None:
        mesh, report = self.report("wall-angle.ply", 0.93)

        def moved(key: str, axis: int, shift: float):
            def change(part: dict) -> None:
                part["regions"][0][key][axis] += shift
            return change

        def diameter(part: dict) -> None:
            part["min"] = part["regions"][0]["min"] = 0.88

        def face(key: str, value: int):
            return lambda part: part["regions"][0].update({key: value})

        def other_side(part: dict) -> None:
            part["regions"][0].update({"opposite": part["regions"][0]["place"], "oppositeFace": part["regions"][0]["minFace"]})

        place = report["thickness"]["regions"][0]
        along = next(axis for axis in range(2) if place["place"][axis] != place["opposite"][axis])
        self.refused(mesh, report, "has the diameter 0.9", diameter)
        self.refused(mesh, report, "the point is .* away from the face", moved("place", along, 0.01))
        self.refused(mesh, report, "the opposite point is .* away", moved("opposite", along, -0.01))
        self.refused(mesh, report, "has the diameter", moved("opposite", 1 - along, 0.1))
        self.refused(mesh, report, "the point is .* away", face("minFace", place["oppositeFace"]))
        self.refused(mesh, report, "does not exist", face("minFace", 10_000))
        self.refused(mesh, report, "do not oppose each other", other_side)
        self.refused(mesh, report, "none of the regions", lambda part: part.update({"min": 0.5}))

    def test_balls_with_a_nearer_wall_inside_are_refused(self) -> None:
        # A wedge: a ball through a point behind the nearest one is too large.
        mesh, report = self.report("edge-wedge-12.ply", 0.8)

        def change(part: dict) -> None:
            region = part["regions"][0]
            place, opposite = region["place"], region["opposite"]
            edge = [0.0, 0.0, place[2]]
            region["opposite"] = [2 * b - a for a, b in zip(edge, opposite)]
            v = [b - a for a, b in zip(place, region["opposite"])]
            corners, face_of, _ = mesh_files.read_mesh(mesh)
            normal = verify_report.Solid(corners, face_of).normals[region["minFace"]]
            region["min"] = part["min"] = sum(x * x for x in v) / -sum(x * n for x, n in zip(v, normal))
            part["thinnerThan"] = 10 * region["min"]

        self.refused(mesh, report, "an opposing wall is inside of the ball", change)

    def test_changed_verdicts_are_refused(self) -> None:
        def passed(part: dict) -> None:
            part.update({"verdict": "passed", "regions": []})

        def not_judged(part: dict) -> None:
            part.update({"verdict": "notJudged"})

        def with_cause(part: dict) -> None:
            part["verdict"], part["unjudged"]["reasons"] = "notJudged", [{"cause": "border"}]

        def as_gap(part: dict) -> None:
            part["regions"][0]["kind"] = "detail"

        for name, limit, check in (("wall-floor-0.4.ply", 0.8, "thinner"), ("gap-boxes-0.4.ply", 0.5, "closer"),
                                   ("edge-wedge-8.ply", 0.8, "thinner"), ("gap-pin-12.ply", 0.25, "closer"),
                                   ("sound-overlap.ply", 1.03, "thinner"), ("edge-rib-3.ply", 0.8, "thinner")):
            mesh, report = self.report(name, limit, check)
            self.refused(mesh, report, "is missing", passed)
            self.refused(mesh, report, "no reason is reported", not_judged)
            self.refused(mesh, report, "but the surface bounds a solid", with_cause)
            self.refused(mesh, report, "no (wall|gap) is reported", as_gap)
        mesh, report = self.report("thin-body-tetrahedron.ply", 1.7)
        self.refused(mesh, report, "thin as a whole", passed)
        mesh, report = self.report("thin-body-tetrahedron.ply", 1.5)
        self.refused(mesh, report, "no wall is reported", lambda part: part.update({"verdict": "failed"}))
        mesh, report = self.report("danger-open-box.ply", 0.5)

        def without_reasons(part: dict) -> None:
            part["verdict"], part["unjudged"]["reasons"] = "passed", []

        self.refused(mesh, report, "the surface is open", without_reasons)

    def test_a_missing_second_wall_is_refused(self) -> None:
        mesh = self.folder / "two.off"
        first, second = (mesh_files.read_mesh(self.folder / f"wall-floor-{floor}.ply").corners for floor in ("0.4", "0.2"))
        second = second + [50.0, 0, 0]
        points = [tuple(point) for corners in (first, second) for point in corners.reshape(-1, 3)]
        faces = [f"3 {i} {i + 1} {i + 2}" for i in range(0, len(points), 3)]
        rows = [" ".join(map(repr, map(float, point))) for point in points] + faces
        mesh.write_text("\n".join(["OFF", f"{len(points)} {len(faces)} 0", *rows]) + "\n")
        report = report_of(mesh, "--thinner-than", "0.8")
        self.assertEqual(len(report["thickness"]["regions"]), 2)
        self.refused(mesh, report, "a wall of 0.4.* is missing", lambda part: part["regions"].pop())

    def test_the_script_prints_reasons_and_sets_its_exit_code(self) -> None:
        mesh, report = self.report("wall-floor-0.4.ply", 0.8)

        def run(text: str) -> subprocess.CompletedProcess[str]:
            return subprocess.run([SCRIPT, mesh, "-"], input=text, capture_output=True, text=True, check=False)

        good = run(json.dumps(report))
        self.assertEqual((good.returncode, good.stderr), (0, ""))
        self.assertIn("verified: places of 1 walls", good.stdout)
        report["thickness"]["regions"][0]["place"][2] += 0.05
        bad = run(json.dumps(report))
        self.assertEqual(bad.returncode, 1)
        self.assertIn("WRONG: wall 0.4", bad.stdout)
        self.assertEqual(run("{").returncode, 2)
        for wrong, reason in (({"mesh": "a.ply", "error": "unreadable"}, "no report on a mesh: unreadable"),
                              (report | {"faceCount": 7}, "of 7"), (report | {"reversedFaceCount": 3}, "reversed by --orient"),
                              (report | {"with": ["b.ply"]}, "1 meshes of --with"), (report | {"thickness": None}, "no limit"),
                              ([], "no report on a mesh")):
            refused = run(json.dumps(wrong))
            self.assertEqual((refused.returncode, refused.stdout), (2, ""))
            self.assertRegex(refused.stderr, f"^verify-report: .*{reason}.*\n$")

    def test_a_report_with_other_meshes_is_verified_on_the_faces_of_the_first(self) -> None:
        box = "OFF\n8 13 0\n" + "\n".join(f"{{}} {y} {z}" for z in (0, 1) for y in (0, 1) for _ in (0, 1)) + "\n" + "\n".join(
            ["3 0 2 1", "3 1 2 3", "3 4 5 6", "3 5 7 6", "3 0 1 4", "3 1 5 4", "3 2 6 3", "3 3 6 7", "3 0 4 2", "3 2 4 6",
             "3 1 3 5", "3 3 7 5", "2 0 1"]) + "\n"  # The last face has no area.
        paths = [self.folder / f"apart-{x}.off" for x in (0, 1.2, 2.3)]
        for path, x in zip(paths, (0, 1.2, 2.3), strict=True):
            path.write_text(box.format(*[x, x + 1] * 4))
        options = [word for path in paths[1:] for word in ("--with", str(path))]
        report = report_of(paths[0], *options, "--closer-than", "0.3")
        self.assertEqual((report["gap"]["verdict"], report["withFaceCounts"]), ("failed", [13, 13]))
        mesh, *others = map(mesh_files.read_mesh, paths)
        self.assertEqual(verify_report.verify(mesh, report, others=others).wrong, [])
        report["gap"].update({"verdict": "passed", "regions": []})
        self.assertEqual(len(verify_report.verify(mesh, report, others=others).wrong), 1)  # The gap of 0.1 is of others.


if __name__ == "__main__":
    sys.exit(unittest.main())
