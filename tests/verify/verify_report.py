"""Verifies a report of asdf-vk (--json) against its mesh, without code of the library.

    verify_report.py MESH REPORT.json [--with FILE]... [--wall-angle DEGREES]

MESH: PLY, STL, OFF or OBJ. REPORT.json: the output of asdf-vk MESH --json with --thinner-than or --closer-than; - is
standard input. Prints what holds, and what cannot be verified. Exit code 1: a claim does not hold; its reason is
printed. Exit code 2: the files cannot be read, or the report is not one on walls or gaps of the mesh.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import sys

import mesh_files
from report_checks import Findings, ReportCheck
from solid import Solid


class Unverifiable(Exception):
    """The report is not one on walls or gaps of the mesh."""


def require_verifiable(mesh: mesh_files.Mesh, others: list[mesh_files.Mesh], report: object) -> None:
    if not isinstance(report, dict) or not {"thickness", "gap", "faceCount", "reversedFaceCount"} <= report.keys():
        reason = report.get("error") if isinstance(report, dict) else None
        raise Unverifiable(f"this is no report on a mesh{f': {reason}' if reason else ''}")
    if len(report.get("with", [])) != len(others):
        raise Unverifiable(f"the report has {len(report.get('with', []))} meshes of --with; give each as --with FILE, in this order")
    counts = mesh.face_count + sum(other.face_count for other in others), mesh.face_count
    expected = report["faceCount"], report["regionFaceCount"]
    if counts != expected:
        raise Unverifiable(f"the mesh has {counts[1]} faces of {counts[0]} in all, and the report {expected[1]} of {expected[0]}; "
                           "regions cannot be verified")
    if report["reversedFaceCount"]:
        raise Unverifiable("faces were reversed by --orient; write the mesh with --orient and -o FILE.ply, and verify a report on it")


def verify(mesh: mesh_files.Mesh, report: dict, angle_degrees: float = 120, others: list[mesh_files.Mesh] | None = None) -> Findings:
    """Throws Unverifiable."""
    findings = Findings()
    require_verifiable(mesh, others or [], report)
    whole = mesh_files.joined([mesh, *(others or [])])
    solid = Solid(whole.corners, whole.face_of, mesh.face_count)
    parts = [report[key] for key in ("thickness", "gap") if report[key] is not None and report[key]["thinnerThan"] is not None]
    if not parts:
        raise Unverifiable("the report has no limit of walls or gaps; give --thinner-than or --closer-than")
    for part in parts:
        ReportCheck(solid, part, angle_degrees, findings).run()
    return findings


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("report")
    parser.add_argument("--wall-angle", type=float, default=120, help="the option --wall-angle of the report")
    parser.add_argument("--with", type=pathlib.Path, action="append", default=[], dest="others", metavar="FILE",
                        help="a mesh of the option --with of the report")
    arguments = parser.parse_args()
    try:
        text = sys.stdin.read() if arguments.report == "-" else pathlib.Path(arguments.report).read_text()
        report, mesh = json.loads(text), mesh_files.read_mesh(arguments.mesh)
        others = [mesh_files.read_mesh(path) for path in arguments.others]
    except (OSError, ValueError, KeyError, IndexError) as error:
        print(f"verify-report: {error}", file=sys.stderr)
        return 2
    try:
        findings = verify(mesh, report, arguments.wall_angle, others)
    except Unverifiable as error:
        print(f"verify-report: {error}", file=sys.stderr)
        return 2
    for line in findings.verified:
        print(f"verified: {line}")
    for line in findings.unverified:
        print(f"not verified: {line}")
    for line in findings.wrong:
        print(f"WRONG: {line}")
    return 1 if findings.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
