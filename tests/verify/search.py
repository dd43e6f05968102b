"""Searches the surface for walls (or gaps) that a report does not have."""

from __future__ import annotations

import numpy as np

from surface import THIN, Surface

GREATEST_COUNT = 40_000  # Points of the whole surface.
TRIED_PER_CLUSTER = 24


class ThinPoints:
    """Thin points of the surface in cubic cells. Cells that touch are a cluster; a wall has both of its sides in one."""

    def __init__(self, surface: Surface) -> None:
        solid, limit = surface.solid, surface.limit
        area = float(np.linalg.norm(np.cross(solid.triangles[:, 1] - solid.triangles[:, 0],
                                             solid.triangles[:, 2] - solid.triangles[:, 0]), axis=1).sum()) / 2
        self.surface = surface
        self.spacing = max(0.4 * limit, float(np.sqrt(area / GREATEST_COUNT)))
        self.count = self.face_count = 0
        self.points: list[tuple[float, np.ndarray, int]] = []  # Thickness, place, triangle.
        self.cells: dict[tuple[int, ...], tuple[int, ...]] = {}  # The parent of each cell; roots are clusters.
        for triangle in np.flatnonzero((solid.kinds != 0) & solid.is_judged).tolist():
            self._add_triangle(triangle)
        for cell in list(self.cells):
            self._join_neighbours(cell)

    def _add_triangle(self, triangle: int) -> None:
        limit = self.surface.limit
        if len(self.surface.opposing(triangle, limit)) == 0:
            return
        points = self.surface.grid(triangle, self.spacing)
        self.count += len(points)
        self.face_count += 1
        values, opposite, is_certain = self.surface.thickness(points, triangle, limit)
        for i in np.flatnonzero((values < THIN * limit) & is_certain):
            self.points.append((float(values[i]), points[i], triangle))
            self._join(self._cell_at(points[i]), self._cell_at(opposite[i]))

    def _cell_at(self, point: np.ndarray) -> tuple[int, ...]:
        cell = tuple(np.floor(point / self.spacing).astype(int).tolist())
        self.cells.setdefault(cell, cell)
        return cell

    def _root(self, cell: tuple[int, ...]) -> tuple[int, ...]:
        while self.cells[cell] != cell:
            self.cells[cell] = self.cells[self.cells[cell]]
            cell = self.cells[cell]
        return cell

    def _join(self, cell: tuple[int, ...], other: tuple[int, ...]) -> None:
        self.cells[self._root(cell)] = self._root(other)

    def _join_neighbours(self, cell: tuple[int, ...]) -> None:
        for step in np.ndindex(3, 3, 3):
            other = tuple(a + b - 1 for a, b in zip(cell, step, strict=True))
            if other in self.cells:
                self._join(cell, other)

    def clusters(self) -> dict[tuple[int, ...], list[tuple[float, np.ndarray, int]]]:
        found: dict[tuple[int, ...], list[tuple[float, np.ndarray, int]]] = {}
        for point in self.points:
            found.setdefault(self._root(self._cell_at(point[1])), []).append(point)
        return found

    def cluster_of(self, place: np.ndarray) -> set[tuple[int, ...]]:
        """The clusters of the cells at and around a place."""
        cell = np.floor(place / self.spacing).astype(int)
        around = (tuple((cell + step - 1).tolist()) for step in np.ndindex(3, 3, 3))
        return {self._root(other) for other in around if other in self.cells}


def first_wall(surface: Surface, points: list[tuple[float, np.ndarray, int]]) -> tuple[float, np.ndarray, int] | None:
    """The first point that is a wall by a strict test, on a coarse disc and then on a fine one.

    Points of nearly no thickness are left out: whether the surface tapers off beside them is not resolved.
    """
    step = max(1, len(points) // TRIED_PER_CLUSTER)
    resolved = [point for point in points if point[0] > 32 * surface.solid.resolution]
    for point in sorted(resolved, key=lambda each: each[0])[::step]:
        _, place, triangle = point
        if surface.is_wall(place, triangle, 0.1) and surface.is_wall(place, triangle, 0.1, ring_count=12):
            return point
    return None


def search(surface: Surface, reported: list[tuple[float, np.ndarray]], any_thin_counts: bool) -> tuple[list[str], str]:
    """Returns what is wrong, and what was searched. reported: thickness and both points of each reported wall."""
    thin = ThinPoints(surface)
    noun = "gap" if surface.is_of_gaps else "wall"
    known: dict[tuple[int, ...], float] = {}
    for value, place in reported:
        for cluster in thin.cluster_of(place):
            known[cluster] = min(value, known.get(cluster, np.inf))
    wrong = []
    for cluster, points in thin.clusters().items():
        if cluster in known:
            # The places of a cluster may be those of several walls; none is thinner than the least one.
            points = [point for point in points if point[0] < 0.9 * known[cluster]]
        found = points[0] if any_thin_counts and cluster not in known else first_wall(surface, points)
        if found is not None:
            value, place, triangle = found
            text = f"a {noun} of {value:.6g} at {place.round(6).tolist()}, face {surface.solid.face_of[triangle]}"
            wrong.append(f"{text}, is missing" if cluster not in known else f"{text}, is thinner than the reported one")
    text = f"{thin.count} points {thin.spacing:.3g} apart ({len(thin.points)} thin) of {thin.face_count} triangles with an " \
           "opposing wall within the limit"
    return wrong, text
