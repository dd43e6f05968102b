"""Two simple checks of wall thickness, as other tools do it: a ray per face, and shrinking balls between sampled points.

Both judge every surface, closed or not, and compare the least distance (for thick bodies the greatest one) with the limit.
"""
from __future__ import annotations

import numpy as np

SAMPLE_COUNT = 1_500


def unit_normals(corners: np.ndarray) -> np.ndarray:
    """(n, 3); NaN for triangles without area."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    with np.errstate(invalid="ignore", divide="ignore"):
        return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def ray_lengths(origins: np.ndarray, directions: np.ndarray, corners: np.ndarray, step: float) -> np.ndarray:
    """For each ray, the distance of its nearest hit beyond `step`; infinite without a hit. Moeller and Trumbore 1997."""
    lengths = np.full(len(origins), np.inf)
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    for i, (origin, direction) in enumerate(zip(origins, directions, strict=True)):
        with np.errstate(invalid="ignore", divide="ignore"):
            across = np.cross(direction, second)
            inverse = 1 / (first * across).sum(1)
            shift = origin - corners[:, 0]
            u = (shift * across).sum(1) * inverse
            other = np.cross(shift, first)
            v = other @ direction * inverse
            t = (second * other).sum(1) * inverse
            hits = t[(u >= -1e-12) & (v >= -1e-12) & (u + v <= 1 + 1e-12) & (t > step)]
        lengths[i] = hits.min(initial=np.inf)
    return lengths


def ball_diameters(points: np.ndarray, inwards: np.ndarray) -> np.ndarray:
    """For each point, the diameter of the ball that touches it, and holds no point of an opposing wall.

    Ma, Bae and Choi 2012. Opposing walls have normals at 120 degrees or more, as those of asdf-vk; without this rule,
    every edge of a box would be thin.
    """
    size = np.ptp(points, axis=0).max()
    radii = np.full(len(points), 2 * size)
    is_beside = inwards @ inwards.T > -0.499
    for _ in range(30):
        centres = points + radii[:, None] * inwards
        squares = (centres**2).sum(1)[:, None] + (points**2).sum(1) - 2 * centres @ points.T
        squares[is_beside] = np.inf
        nearest = squares.argmin(1)
        offsets = points[nearest] - points
        distances = np.sqrt(np.maximum(squares[np.arange(len(points)), nearest], 0))
        along = (offsets * inwards).sum(1)
        shrinks = (distances < radii - 1e-6 * size) & (along > 1e-9 * size)
        if not shrinks.any():
            break
        radii[shrinks] = (offsets[shrinks]**2).sum(1) / (2 * along[shrinks])
    return 2 * radii


class SimpleChecks:
    """corners: (n, 3, 3). The results of both checks are kept for further limits."""

    def __init__(self, corners: np.ndarray) -> None:
        normals = unit_normals(corners)
        is_sound = np.isfinite(normals).all(1)
        self.corners, self.normals = corners[is_sound], normals[is_sound]
        self.size = np.ptp(self.corners.reshape(-1, 3), axis=0).max()
        self.known: dict[tuple[str, bool], np.ndarray] = {}

    def by_rays(self, check: str, limit: float) -> str:
        return self._verdict(check, limit, self._once("rays", check == "closer", self._lengths))

    def by_balls(self, check: str, limit: float) -> str:
        return self._verdict(check, limit, self._once("balls", check == "closer", self._diameters))

    def _once(self, name: str, is_outside: bool, compute) -> np.ndarray:
        if (name, is_outside) not in self.known:
            self.known[name, is_outside] = compute(1 if is_outside else -1)
        return self.known[name, is_outside]

    @staticmethod
    def _verdict(check: str, limit: float, lengths: np.ndarray) -> str:
        lengths = lengths[np.isfinite(lengths)]
        if check == "thicker":
            return "fail" if lengths.max(initial=0) > limit else "pass"
        return "fail" if lengths.min(initial=np.inf) < 0.999 * limit else "pass"

    def _lengths(self, side: int) -> np.ndarray:
        return ray_lengths(self.corners.mean(1), side * self.normals, self.corners, 1e-7 * self.size)

    def _diameters(self, side: int) -> np.ndarray:
        random = np.random.default_rng(1)
        areas = np.linalg.norm(np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0]), axis=1)
        faces = random.choice(len(areas), SAMPLE_COUNT, p=areas / areas.sum())
        u, v = random.random((2, SAMPLE_COUNT, 1))
        root, (a, b, c) = np.sqrt(u), self.corners[faces].swapaxes(0, 1)
        diameters = ball_diameters((1 - root) * a + root * (1 - v) * b + root * v * c, side * self.normals[faces])
        # A ball that nothing limits has no diameter.
        return np.where(diameters < 3.9 * self.size, diameters, np.inf)
