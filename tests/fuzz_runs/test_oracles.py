"""Each oracle accepts a right result and refuses a planted wrong one."""

from __future__ import annotations

import array
import dataclasses
import math
import os
import pathlib
import random
import signal
import struct
import tempfile
import unittest

import options
import oracles
import results
import shapes
from runner import class_of, run_case
from program import Ended, Program

VALUES = [0.5, 1.0, 2.0, math.nan] * 500
RIGHT = Ended("asdf-vk mesh.off", 0, b"", "", 0.1)


def changed(values: list[float], changes: dict[int, float]) -> list[float]:
    return [changes.get(i, value) for i, value in enumerate(values)]


def npy(values: list[float]) -> bytes:
    header = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({len(values)},), }}\n".encode()
    begin = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header))
    return begin + header + array.array("f", values).tobytes()


class EndOfARun(unittest.TestCase):
    def test_documented_codes_are_accepted(self) -> None:
        self.assertEqual(oracles.ended_well(RIGHT), [])
        refused = dataclasses.replace(RIGHT, code=2, error="asdf-vk: error: no faces\n")
        self.assertEqual(oracles.ended_well(refused), [])
        interrupted = dataclasses.replace(RIGHT, code=130, sent=(signal.SIGINT,))
        self.assertEqual(oracles.ended_well(interrupted), [])
        killed = dataclasses.replace(RIGHT, code=-9, sent=(signal.SIGKILL,))
        self.assertEqual(oracles.ended_well(killed), [])

    def test_others_are_refused(self) -> None:
        for code in (70, 153, 9, -signal.SIGSEGV, -signal.SIGKILL, 130, None, 2):
            with self.subTest(code=code):
                self.assertTrue(oracles.ended_well(dataclasses.replace(RIGHT, code=code)))
        other = dataclasses.replace(RIGHT, code=-signal.SIGSEGV, sent=(signal.SIGINT,))
        self.assertTrue(oracles.ended_well(other))


class Values(unittest.TestCase):
    def test_rounding_and_few_faces_agree(self) -> None:
        near = [value * (1 + 5e-4) for value in VALUES]
        self.assertEqual(oracles.same_values(VALUES, near, 1e-7), [])
        few = changed(VALUES, {0: 9.0, 1: math.nan})
        self.assertEqual(oracles.same_values(VALUES, few, 1e-7), [])
        self.assertEqual(oracles.equal_values(VALUES, list(VALUES)), [])

    def test_other_values_differ(self) -> None:
        wrong = {4 * i: 1e-17 for i in range(5)}
        missing = {4 * i: math.nan for i in range(5)}
        invented = {4 * i + 3: 1.0 for i in range(5)}
        for changes in (wrong, missing, invented):
            self.assertTrue(oracles.same_values(VALUES, changed(VALUES, changes), 1e-7))
        self.assertTrue(oracles.same_values(VALUES, [value * 1.002 for value in VALUES], 1e-7))
        self.assertTrue(oracles.same_values(VALUES, VALUES[:-1], 1e-7))
        self.assertTrue(oracles.equal_values(VALUES, changed(VALUES, {7: 1.0})))
        self.assertTrue(oracles.equal_values(VALUES, changed(VALUES, {8: 0.5000001})))
        self.assertTrue(oracles.equal_values(VALUES, VALUES[:-1]))

    def test_impossible_values_and_other_labels_are_refused(self) -> None:
        self.assertEqual(oracles.possible_values(VALUES), [])
        self.assertTrue(oracles.possible_values([1, -1e-9]))
        self.assertTrue(oracles.possible_values([1, math.inf]))
        self.assertEqual(oracles.same_labels([0, 1, 1], [0, 1, 1]), [])
        self.assertTrue(oracles.same_labels([0, 1, 1], [0, 1, 2]))
        self.assertTrue(oracles.same_labels([0, 1, 1], [0, 1]))


class Files(unittest.TestCase):
    def setUp(self) -> None:
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def test_half_a_file_is_neither_the_old_nor_the_new_one(self) -> None:
        for result in (b"old", b"the new one"):
            self.assertEqual(oracles.old_or_new(result, b"old", b"the new one"), [])
        self.assertEqual(oracles.old_or_new(None, None, b"the new one"), [])
        for result, old in ((b"the n", b"old"), (b"", b"old"), (None, b"old"), (b"", None)):
            self.assertTrue(oracles.old_or_new(result, old, b"the new one"))
        self.assertEqual(oracles.same_bytes(b"same", b"same"), [])
        self.assertTrue(oracles.same_bytes(b"same", b"sane"))
        self.assertTrue(oracles.same_bytes(b"same", b"same."))
        two = {"a": b"1", "b": b"2"}
        self.assertEqual(oracles.same_results(two, dict(two)), [])
        self.assertTrue(oracles.same_results(two, {"a": b"1"}))
        self.assertTrue(oracles.same_results(two, {"a": b"1", "b": b"3"}))

    def test_partial_files_are_left_by_sigkill_only(self) -> None:
        self.assertEqual(oracles.no_partial_files(self.folder, RIGHT), [])
        (self.folder / "out").mkdir()
        (self.folder / "out" / ".asdf-vk-1-1.part").touch()
        interrupted = dataclasses.replace(RIGHT, sent=(signal.SIGINT,))
        self.assertTrue(oracles.no_partial_files(self.folder, interrupted))
        killed = dataclasses.replace(RIGHT, sent=(signal.SIGKILL,))
        self.assertEqual(oracles.no_partial_files(self.folder, killed), [])

    def test_incomplete_files_are_not_sound(self) -> None:
        complete = {
            "a.npy": npy(VALUES),
            "a.csv": b"face,sdf\n0,1.5\n1,nan\n",
            "a.html": b"<html></html>\n",
            "a.vtu": b"<VTKFile></VTKFile>\n",
            "a.png": b"...IEND\xaeB`\x82",
        }
        for name, data in complete.items():
            with self.subTest(name=name):
                path = self.folder / name
                path.write_bytes(data)
                self.assertEqual(results.sound(path), "")
                path.write_bytes(data[:-3])
                self.assertTrue(results.sound(path))
        self.assertEqual(results.of_npy(npy([1.5, 2.0])), [1.5, 2.0])


class Reports(unittest.TestCase):
    FIELDS = {"sdf": [1.0, 3.0, math.nan], "seed": [1.0, 0.0, 0.0], "segment": [0.0, 1.0, 1.0]}
    FIELD = {
        **{"name": "sdf", "components": 1, "per": "face", "type": "float64"},
        **{"missingCount": 1, "min": 1, "max": 3},
    }
    REPORT = {
        **{"faceCount": 3, "noValueCount": 1, "seedCount": 1, "segmentCount": 2},
        **{"sdf": {"min": 1, "max": 3}, "fields": [FIELD]},
    }

    def test_a_right_report_agrees(self) -> None:
        self.assertEqual(oracles.report_agrees(self.REPORT, self.FIELDS), [])
        self.assertEqual(oracles.reports_of(b'{"a": null}\n'), ([{"a": None}], []))

    def test_each_wrong_number_is_found(self) -> None:
        for key in ("faceCount", "noValueCount", "seedCount", "segmentCount"):
            with self.subTest(key=key):
                self.assertTrue(oracles.report_agrees({**self.REPORT, key: 7}, self.FIELDS))
        wrong = {**self.REPORT, "sdf": {"min": 1, "max": 3.1}}
        self.assertTrue(oracles.report_agrees(wrong, self.FIELDS))
        for key in ("missingCount", "min", "max"):
            wrong = {**self.REPORT, "fields": [{**self.FIELD, key: 5}]}
            self.assertTrue(oracles.report_agrees(wrong, self.FIELDS))

    def test_what_is_no_json_is_found(self) -> None:
        for text in (b"{", b'{"a": NaN}', b'{"a": 1} {'):
            self.assertTrue(oracles.reports_of(text)[1])


class Options(unittest.TestCase):
    def test_names_are_read_from_the_help(self) -> None:
        text = "Options:\n  -o,--output FILE   Text about --seeds\n  --seeds N%|N|all   more\n"
        self.assertEqual(options.names_in_help(text), {"--output", "--seeds"})

    @unittest.skipUnless("ASDF_VK_PROGRAM" in os.environ, "ASDF_VK_PROGRAM is not set")
    def test_the_tables_have_all_options(self) -> None:
        path = pathlib.Path(os.environ.get("ASDF_VK_PROGRAM", ""))
        self.assertEqual(options.missing_in_tables(Program(path, path, path).help()), set())

    def test_findings_that_differ_in_numbers_only_are_one(self) -> None:
        first = class_of("units", "", "values differ: at 3 of 5 faces  [asdf-vk a -o b]")
        second = class_of("units", "", "values differ: at 4 of 9 faces  [asdf-vk c -o d]")
        self.assertEqual(first, second)
        self.assertNotEqual(first, class_of("units", "x", "values differ: at 3 of 5 faces"))


class WholeCases(unittest.TestCase):
    """Cases with programs in the place of asdf-vk that do something wrong."""

    OUTPUT = 'while [ "$1" ]; do [ "$1" = -o ] && out=$2; shift; done; '
    SCRIPTS = {
        "exit 70": ("any-options", "exit code 70"),
        "kill -SEGV $$": ("any-options", "SIGSEGV"),
        "exit 0": ("any-options", "without a result"),
        "touch .asdf-vk-1.part": ("any-options", "partial file"),
        OUTPUT + 'head -c 9999 /dev/zero >"$out"; true': ("limited-files", "code 0, res"),
        OUTPUT + 'date +%N >"$out"': ("killed", "neither the old nor"),
    }

    def test_wrong_programs_are_found(self) -> None:
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            mesh = folder / "mesh.ply"
            mesh.write_bytes(tetrahedron())
            generate = script(folder / "generate", f'for out; do :; done; cp "{mesh}" "$out"')
            for text, (kind, expected) in self.SCRIPTS.items():
                with self.subTest(script=text):
                    program = Program(script(folder / "program", text), generate, generate)
                    findings: list[str] = []
                    for seed in range(6):
                        findings += run_case(program, kind, seed, folder / "case").findings
                    self.assertIn(expected, "\n".join(findings))


def script(path: pathlib.Path, text: str) -> pathlib.Path:
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)
    return path


def tetrahedron() -> bytes:
    header = b"ply\nelement vertex 4\nelement face 4\nend_header\n"
    corners = struct.pack("<12d", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)
    faces = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
    return header + corners + b"".join(struct.pack("<B3ifi", 3, *face, 0.0, 0) for face in faces)


class Shapes(unittest.TestCase):
    def test_changes_keep_a_mesh_readable(self) -> None:
        with tempfile.TemporaryDirectory() as scratch:
            path = pathlib.Path(scratch) / "generated.ply"
            path.write_bytes(tetrahedron())
            mesh = shapes.read_generated(path, "tetrahedron")
            self.assertEqual(mesh.faces[1], (0, 1, 3))
            for change in shapes.DEFECTS:
                other = change(mesh, random.Random(1))
                self.assertTrue(all(0 <= v < 4 for face in other.faces for v in face))
                self.assertEqual(len(other.vertices), 4)
            self.assertAlmostEqual(shapes.scaled(mesh, 3).diagonal(), 3 * mesh.diagonal())


if __name__ == "__main__":
    unittest.main()
