"""Verifies the JSON report of asdf-vk on walls and gaps against the mesh. See verify_report.py."""

from __future__ import annotations

import dataclasses

import numpy as np

import geometry
from search import search
from solid import Solid
from surface import THIN, Surface

CLOSE = 1e-6  # Relative tolerance of diameters.


@dataclasses.dataclass
class Findings:
    """Sentences: what holds, what is wrong, and what was not verified."""

    verified: list[str] = dataclasses.field(default_factory=list)
    wrong: list[str] = dataclasses.field(default_factory=list)
    unverified: list[str] = dataclasses.field(default_factory=list)


class ReportCheck:
    """A report on walls ("thickness") or on gaps ("gap")."""

    def __init__(self, solid: Solid, report: dict, angle_degrees: float, findings: Findings) -> None:
        self.solid, self.report, self.findings = solid, report, findings
        self.noun = "gap" if report["isOfGaps"] else "wall"
        self.limit = report["thinnerThan"]
        self.surface = Surface(solid, report["isOfGaps"], self.limit, angle_degrees)
        self.tolerance = 4 * solid.resolution

    def refuse(self, text: str) -> None:
        self.findings.wrong.append(text)

    def run(self) -> None:
        regions = self.report["regions"]
        for region in regions:
            self._check_place(region)
        kinds = [region["kind"] for region in regions]
        counts = ", ".join(f"{kinds.count(kind)} {kind}s" for kind in (self.noun, "detail", "edge"))
        self.findings.verified.append(f"places of {counts}: points, faces, angles, balls")
        self._check_verdict()
        if self.solid.is_whole:
            self._search()
        else:
            self.findings.unverified.append(f"no search for other {self.noun}s: {self.solid.worst}")

    # Places.

    def _triangle_at(self, face: int, point: np.ndarray, what: str, name: str) -> int | None:
        triangles = self.solid.of_face(face)
        if len(triangles) == 0:
            self.refuse(f"{name}: the face {face} does not exist, or has no area")
            return None
        distances = np.linalg.norm(geometry.nearest_on_triangles(point[None], self.solid.triangles[triangles])[0] - point, axis=1)
        if distances.min() > self.tolerance:
            self.refuse(f"{name}: the {what} is {distances.min():.3g} away from the face {face}")
            return None
        return int(triangles[distances.argmin()])

    def _check_place(self, region: dict) -> None:
        name = f"{region['kind']} {region['min']:.6g} at face {region['minFace']}"
        place, opposite = np.array(region["place"], float), np.array(region["opposite"], float)
        own = self._triangle_at(region["minFace"], place, "point", name)
        if own is None:
            return
        if not region["min"] < THIN * self.limit * (1 + CLOSE):
            self.refuse(f"{name}: it is not below the limit {self.limit:.6g}")
        if self._is_sheet(region, own, name):
            return
        if region["oppositeFace"] is None:
            self._check_whole_body(region, own, name)
            return
        other = self._triangle_at(region["oppositeFace"], opposite, "opposite point", name)
        if other is None:
            return
        if self.solid.normals[own] @ self.solid.normals[other] > self.surface.cosine + 1e-6:
            self.refuse(f"{name}: the faces {region['minFace']} and {region['oppositeFace']} do not oppose each other")
            return
        if self._check_ball(region, own, place, opposite, name) and region["kind"] == self.noun:
            self._check_kind(region, own, place, name)

    def _is_sheet(self, region: dict, own: int, name: str) -> bool:
        """Whether the place is on a surface without material on both sides. Its thickness is 0."""
        if not (self.solid.is_whole and self.solid.is_sheet[own]):
            return False
        if region["min"] > self.tolerance:
            self.refuse(f"{name}: there is no material, so the thickness is 0")
        return True

    def _check_ball(self, region: dict, own: int, place: np.ndarray, opposite: np.ndarray, name: str) -> bool:
        inwards = self.surface.side * self.solid.normals[own]
        v = opposite - place
        depth, square = float(v @ inwards), float(v @ v)
        if np.sqrt(square) <= self.tolerance:
            diameter = 0.0
        elif depth <= 0:
            self.refuse(f"{name}: the opposite point is not in front of the face")
            return False
        else:
            diameter = square / depth
        allowed = CLOSE * diameter + self.tolerance
        section = self.report["greatestSection"]
        is_capped = section is not None and diameter > region["min"] and abs(region["min"] - section["diameter"]) <= allowed
        if abs(diameter - region["min"]) > allowed and not is_capped:
            self.refuse(f"{name}: the ball through both points has the diameter {diameter:.9g}")
            return False
        least, _, is_certain = self.surface.thickness(place[None], own, 2 * diameter + self.tolerance)
        if is_certain[0] and least[0] < region["min"] * (1 - CLOSE) - self.tolerance:
            self.refuse(f"{name}: an opposing wall is inside of the ball; the thickness there is {least[0]:.9g}")
            return False
        return True

    def _check_kind(self, region: dict, own: int, place: np.ndarray, name: str) -> None:
        if self.surface.is_wall(place, own, -0.1):
            return
        if not self.report["isOfGaps"] and self.solid.is_whole:
            if self.solid.greatest_ball(self.solid.bodies[own], THIN * self.limit)[0] < THIN * self.limit:
                return  # The body is a wall as a whole.
        self.refuse(f"{name}: the surface around the place is no {self.noun}")

    def _check_whole_body(self, region: dict, own: int, name: str) -> None:
        if not self.solid.is_whole or self.report["isOfGaps"]:
            self.findings.unverified.append(f"{name}: the greatest ball of the body")
            return
        found, bound = self.solid.greatest_ball(self.solid.bodies[own], THIN * self.limit)
        if found >= THIN * self.limit or bound > THIN * self.limit * (1 + CLOSE):
            self.refuse(f"{name}: a ball of the diameter {found:.6g} fits inside of the body")
        elif found > region["min"] * 1.002:
            self.refuse(f"{name}: a greater ball, {found:.6g}, fits inside of the body")

    # The verdict.

    def _counts(self, region: dict) -> bool:
        return region["kind"] == self.noun or self.report["countsEdges"] or (
            self.report["countsDetails"] and region["kind"] == "detail")

    def _check_verdict(self) -> None:
        report, verdict = self.report, self.report["verdict"]
        counted = [region for region in report["regions"] if self._counts(region)]
        if verdict == "failed":
            if not counted:
                self.refuse(f"the verdict is failed, but no {self.noun} is reported")
            elif abs(min(region["min"] for region in counted) - report["min"]) > CLOSE * report["min"]:
                self.refuse(f"the least {self.noun}, {report['min']:.9g}, is none of the regions")
        elif verdict == "passed":
            if counted:
                self.refuse(f"the verdict is passed, but a {self.noun} of {counted[0]['min']:.6g} is reported")
            if report["unjudged"]["reasons"]:
                self.refuse("the verdict is passed, but faces were not judged")
            if not self.solid.is_whole:
                self.refuse(f"the verdict is passed, but {self.solid.worst}")
        else:
            self._check_reasons()

    def _check_reasons(self) -> None:
        causes = {reason["cause"] for reason in self.report["unjudged"]["reasons"]}
        if not causes:
            self.refuse("the verdict is notJudged, but no reason is reported")
        elif causes <= {"negativeVolumes", "coarseCoordinates"}:
            self.findings.unverified.append(f"the cause {', '.join(sorted(causes))}")
        elif self.solid.is_whole and self.solid.deviation < 1e-5 and not self.solid.is_sheet.any():
            self.refuse(f"the verdict is notJudged ({', '.join(sorted(causes))}), but the surface bounds a solid")
        else:
            self.findings.verified.append(f"the surface bounds no solid ({self.solid.worst or 'it has no material'})")

    # Other walls.

    def _search(self) -> None:
        if self.report["verdict"] == "notJudged":
            return
        reported = [(region["min"], np.array(region[key], float)) for region in self.report["regions"]
                    if self._counts(region) for key in ("place", "opposite")]
        wrong, text = search(self.surface, reported, self.report["countsEdges"])
        self.findings.wrong += wrong
        if self.report["verdict"] == "passed" and not self.report["isOfGaps"]:
            wrong += self._thin_bodies()
        if not wrong:
            self.findings.verified.append(f"no other {self.noun} below {self.limit:.6g} at {text}")

    def _thin_bodies(self) -> list[str]:
        wrong = []
        if self.solid.is_sheet[self.solid.kinds == 0].any():
            wrong.append("a surface has no material on both sides")
        for body in np.unique(self.solid.bodies[(self.solid.kinds > 0) & self.solid.is_judged]):
            found, bound = self.solid.greatest_ball(body, THIN * self.limit * 0.998)
            if found < THIN * self.limit * 0.998 and bound <= THIN * self.limit * 0.998:
                wrong.append(f"a body is thin as a whole: its greatest ball has at most the diameter {bound:.6g}")
        self.findings.wrong += wrong
        return wrong

