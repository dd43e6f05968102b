"""Verifies a report of asdf-vk (--json) against its mesh, without code of the library.

    verify_report.py MESH REPORT.json [--wall-angle DEGREES]

MESH: PLY, STL, OFF or OBJ. REPORT.json: the output of asdf-vk MESH --json with --thinner-than or --closer-than; - is
standard input. Prints what holds, and what cannot be verified. Exit code 1: a claim does not hold; its reason is
printed. Exit code 2: the files cannot be read.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import sys

import mesh_files
from report_checks import Findings, ReportCheck
from solid import Solid


def verify(mesh: mesh_files.Mesh, report: dict, angle_degrees: float = 120) -> Findings:
    findings = Findings()
    solid = Solid(*mesh)
    face_count = int(mesh[1].max()) + 1
    if report["faceCount"] != face_count:
        findings.wrong.append(f"the mesh has {face_count} faces, the report {report['faceCount']}")
        return findings
    parts = [report[key] for key in ("thickness", "gap") if report[key] is not None and report[key]["thinnerThan"] is not None]
    if not parts:
        findings.unverified.append("the report has no limit of walls or gaps")
    for part in parts:
        ReportCheck(solid, part, angle_degrees, findings).run()
    if report["reversedFaceCount"]:
        findings.unverified.append("faces were reversed by --orient; the mesh is verified as it is in the file")
    return findings


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("report")
    parser.add_argument("--wall-angle", type=float, default=120, help="the option --wall-angle of the report")
    arguments = parser.parse_args()
    try:
        text = sys.stdin.read() if arguments.report == "-" else pathlib.Path(arguments.report).read_text()
        report, mesh = json.loads(text), mesh_files.read_mesh(arguments.mesh)
    except (OSError, ValueError, KeyError, IndexError) as error:
        print(f"verify-report: {error}", file=sys.stderr)
        return 2
    findings = verify(mesh, report, arguments.wall_angle)
    for line in findings.verified:
        print(f"verified: {line}")
    for line in findings.unverified:
        print(f"not verified: {line}")
    for line in findings.wrong:
        print(f"WRONG: {line}")
    return 1 if findings.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
