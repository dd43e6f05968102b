"""The thickness of a surface by its definition (docs/thickness.md), by brute force, and the rule for walls."""

from __future__ import annotations

import numpy as np

import geometry
from solid import Solid

THIN = 0.999  # Thin is below this share of the limit.
INNER, OUTER, SHARE = 1 / 3, 3 / 8, 7 / 8  # A wall: thin out to INNER limits, nowhere out to OUTER below SHARE of its thickness.
BESIDE_DEGREES = 107


class Surface:
    """The surface seen from the material, or from the space (gaps)."""

    def __init__(self, solid: Solid, is_of_gaps: bool, limit: float, angle_degrees: float) -> None:
        self.solid, self.is_of_gaps, self.limit = solid, is_of_gaps, limit
        self.cosine = np.cos(np.radians(angle_degrees)) + 1e-3
        self.side = 1 if is_of_gaps else -1
        triangles = solid.triangles
        self.low, self.high = triangles.min(1), triangles.max(1)

    def opposing(self, triangle: int, reach: float) -> np.ndarray:
        """Indices of the opposing walls of a triangle that are at most `reach` away."""
        solid = self.solid
        meets = (self.low <= self.high[triangle] + reach).all(1) & (self.high >= self.low[triangle] - reach).all(1)
        meets &= (solid.normals @ solid.normals[triangle] <= self.cosine + 1e-9) & (solid.kinds != 0)
        if not self.is_of_gaps and solid.is_whole:
            meets &= solid.bodies == solid.bodies[triangle]
        return np.flatnonzero(meets)

    def thickness(self, points: np.ndarray, triangle: int, cap: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(thickness, at most cap; the opposite points; whether the value is certain) of points of a triangle.

        A value is uncertain if its opposite point lies on a face that is inside of the material in part.
        """
        walls = self.opposing(triangle, cap)
        inwards = self.side * self.solid.normals[triangle]
        values, opposite, index = geometry.ball_diameters(points, inwards, self.solid.triangles[walls], cap,
                                                          2 * self.solid.resolution)
        is_certain = np.ones(len(points), bool)
        has_wall = np.flatnonzero(index >= 0)
        of_wall = walls[index[has_wall]] if len(walls) else np.zeros(0, int)
        is_mixed = self.solid.kinds[of_wall] < 0
        checked = has_wall[is_mixed]
        is_certain[checked] = self.solid.are_on_boundary(opposite[checked], self.solid.normals[of_wall[is_mixed]])
        return values, opposite, is_certain

    def grid(self, triangle: int, spacing: float) -> np.ndarray:
        """Points of a triangle that bound the solid."""
        points = geometry.points_on(self.solid.triangles[triangle], spacing)
        return points[self._are_judged(points, triangle)]

    def _are_judged(self, points: np.ndarray, triangle: int) -> np.ndarray:
        if self.solid.kinds[triangle] > 0 or len(points) == 0:
            return np.ones(len(points), bool)
        return self.solid.are_on_boundary(points, np.broadcast_to(self.solid.normals[triangle], points.shape))

    def around(self, place: np.ndarray, triangle: int, radius: float) -> list[int]:
        """The triangles around a place: connected to its triangle, and turned by less than 107 degrees."""
        solid = self.solid
        near = (self.low <= place + radius).all(1) & (self.high >= place - radius).all(1) & (solid.kinds != 0)
        near &= solid.normals @ solid.normals[triangle] > np.cos(np.radians(BESIDE_DEGREES))
        rest = set(np.flatnonzero(near).tolist()) - {triangle}
        found, front = [triangle], [triangle]
        while front and rest:
            current = front.pop()
            others = np.array(sorted(rest))
            a, b = solid.triangles[current], solid.triangles[others]
            # Triangles that touch have a corner of one on the other.
            own = np.linalg.norm(geometry.nearest_on_triangles(a, b) - a[:, None], axis=2).min(0)
            corners = b.reshape(-1, 3)
            theirs = np.linalg.norm(geometry.nearest_on_triangles(corners, a[None])[:, 0] - corners, axis=1).reshape(-1, 3).min(1)
            joined = others[np.minimum(own, theirs) <= 4 * solid.resolution].tolist()
            rest -= set(joined)
            found += joined
            front += joined
        return found

    def is_wall(self, place: np.ndarray, triangle: int, margin: float, ring_count: int = 4) -> bool:
        """Whether a place is a wall. margin: 0.1 is a strict test, -0.1 a lenient one; each number of the rule changes by it."""
        limit, outer = self.limit, OUTER * self.limit * (1 + margin)
        own = self.thickness(place[None], triangle, 2 * limit)
        thickness = own[0][0]
        if not own[2][0] and margin > 0:
            return False
        greatest, least = limit * (THIN - 0.1 * margin), thickness * (SHARE + 0.3 * margin)
        for other in self.around(place, triangle, outer):
            points = geometry.disc_points(place, outer, self.solid.triangles[other], self.solid.normals[other], ring_count)
            points = points[self._are_judged(points, other)]
            if len(points) == 0:
                continue
            values, _, is_certain = self.thickness(points, other, 2 * limit)
            distances = np.linalg.norm(points - place, axis=1)
            is_inner = distances <= INNER * limit * (1 + margin)
            breaks = (values < least) | (is_inner & (values >= greatest))
            if margin < 0:
                breaks &= is_certain
            if breaks.any() or (margin > 0 and not is_certain.all()):
                return False
        return thickness < greatest
