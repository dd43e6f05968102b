"""The solid that a mesh bounds: which points are inside, which triangles bound it, which triangles form a body."""

from __future__ import annotations

import numpy as np

import geometry


class Solid:
    """corners, face_of: of a mesh_files.Mesh. judged_count: walls and gaps are those of the first input faces."""

    def __init__(self, corners: np.ndarray, face_of: np.ndarray, judged_count: float = np.inf) -> None:
        is_finite = np.isfinite(corners).all((1, 2))
        normals = geometry.unit_normals(corners)
        keep = is_finite & (normals != 0).any(1)
        self.has_undefined = not is_finite.all()
        self.triangles, self.normals, self.face_of = corners[keep], normals[keep], face_of[keep]
        self.is_judged = self.face_of < judged_count
        points = self.triangles.reshape(-1, 3)
        self.low, self.high = points.min(0), points.max(0)
        self.half_extent = float((self.high - self.low).max()) / 2
        self.resolution = self.half_extent * 2.0**-20
        self.components = self._components()
        self.contacts = self._find_contacts()
        self.is_whole, self.worst, self.kinds = self._kinds()
        self.bodies = self._bodies()

    def of_face(self, face: int) -> np.ndarray:
        """Indices of the triangles of an input face."""
        return np.flatnonzero(self.face_of == face)

    def windings(self, points: np.ndarray) -> np.ndarray:
        return geometry.winding_numbers(points, self.triangles)

    def sides(self, points: np.ndarray, normals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Winding numbers just inside and just outside of points of the surface."""
        step = 4 * self.resolution * normals
        return self.windings(points - step), self.windings(points + step)

    def are_on_boundary(self, points: np.ndarray, normals: np.ndarray) -> np.ndarray:
        inner, outer = self.sides(points, normals)
        return (inner > 0.5) & (outer < 0.5)

    def _components(self) -> np.ndarray:
        """For each triangle the number of its component, by equal corners."""
        keys = np.round((self.triangles.reshape(-1, 3) - self.low) / (4 * self.resolution)).astype(np.int64)
        vertices = np.unique(keys, axis=0, return_inverse=True)[1].reshape(-1, 3)
        parents = np.arange(vertices.max() + 1)
        changed = True
        while changed:
            least = parents[vertices].min(1)
            before = parents.copy()
            for k in range(3):
                np.minimum.at(parents, vertices[:, k], least)
            parents = parents[parents]
            changed = bool((parents != before).any())
        return np.unique(parents[vertices[:, 0]], return_inverse=True)[1]

    def _kinds(self) -> tuple[bool, str, np.ndarray]:
        """Whether the surface bounds a solid, the reason if not, and the kind of each triangle.

        Kinds: 1: bounds the solid. 0: does so nowhere. -1: in part, perhaps. Three points of each triangle decide, or one
        of each in a fine mesh of one component.
        """
        weights = np.array([[1, 1, 1], [8, 1, 2], [1, 7, 2]], float)
        if self.components.max() == 0 and len(self.triangles) > 300:
            weights = weights[:1]
        weights /= weights.sum(1, keepdims=True)
        points = np.einsum("wk,tkc->twc", weights, self.triangles).reshape(-1, 3)
        normals = np.repeat(self.normals, len(weights), axis=0)
        inner, outer = self.sides(points, normals)
        both = np.stack([inner, outer])
        worst = ""
        self.deviation = float(np.abs(both - np.round(both)).max())
        if self.has_undefined:
            worst = "a corner is not a number"
        elif self.deviation > 2e-3:
            worst = "the surface is open, or wound against itself: a winding number is not whole"
        elif np.round(both).min() < 0:
            worst = "the surface is wound inwards: a winding number is negative"
        is_boundary = ((inner > 0.5) & (outer < 0.5)).reshape(-1, len(weights))
        kinds = np.where(is_boundary.all(1), 1, np.where(is_boundary.any(1), -1, 0))
        self.is_sheet = ((np.round(inner) == 0) & (np.round(outer) == 0)).reshape(-1, len(weights)).all(1)
        if self.components.max() > 0:
            kinds[self._crossed_triangles()] = -1
        return not worst, worst, np.ones_like(kinds) if worst else kinds

    def _near_pairs(self) -> np.ndarray:
        """Pairs of triangles of two components whose boxes meet."""
        low, high = self.triangles.min(1) - self.resolution, self.triangles.max(1) + self.resolution
        pairs = []
        for i in range(len(low)):
            meets = (low <= high[i]).all(1) & (high >= low[i]).all(1) & (self.components != self.components[i])
            pairs += [(i, j) for j in np.flatnonzero(meets)]
        return np.array(pairs, int).reshape(-1, 2)

    def _crossed_triangles(self) -> np.ndarray:
        """Whether a triangle of another component touches or crosses the triangle."""
        crossed = np.zeros(len(self.triangles), bool)
        crossed[self.contacts.reshape(-1)] = True
        return crossed

    def _find_contacts(self) -> np.ndarray:
        contacts = []
        for i, j in self._near_pairs():
            a, b = self.triangles[i], self.triangles[j]
            # Triangles meet if an edge of one meets the other.
            nearest = geometry.nearest_on_triangles(a, b[None])[:, 0]
            if np.linalg.norm(nearest - a, axis=1).min() <= 2 * self.resolution or self._is_pierced(a, b):
                contacts.append((i, j))
        return np.array(contacts, int).reshape(-1, 2)

    def _is_pierced(self, edges: np.ndarray, triangle: np.ndarray) -> bool:
        normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
        heights = (edges - triangle[0]) @ normal
        for k in range(3):
            a, b = heights[k], heights[(k + 1) % 3]
            if a * b < 0:
                point = edges[k] + a / (a - b) * (edges[(k + 1) % 3] - edges[k])
                nearest = geometry.nearest_on_triangles(point[None], triangle[None])[0, 0]
                if np.linalg.norm(nearest - point) <= 2 * self.resolution:
                    return True
        return False

    def _bodies(self) -> np.ndarray:
        """For each triangle the number of its body: components that touch or cross, with their cavities."""
        count = self.components.max() + 1
        if count == 1:
            return self.components
        body = np.arange(count)
        for i, j in self.components[self.contacts]:
            body[body == body[i]] = body[j]
        volumes = np.zeros(count)
        np.add.at(volumes, self.components, np.einsum("tc,tc->t", self.triangles.mean(1), geometry.area_vectors(self.triangles)) / 3)
        for cavity in np.flatnonzero(volumes < 0):
            point = self.triangles[self.components == cavity][0].mean(0)[None]
            around = [other for other in np.flatnonzero(volumes > 0)
                      if geometry.winding_numbers(point, self.triangles[self.components == other])[0] > 0.5]
            if around:
                body[body == body[cavity]] = body[min(around, key=lambda other: volumes[other])]
        return body[self.components]

    def greatest_ball(self, body: int, enough: float) -> tuple[float, float]:
        """Bounds of the diameter of the greatest ball inside of a body, by division of cubes.

        Ends as soon as a ball has the diameter `enough`, or none can have it: then the upper bound is `enough`.
        """
        is_mine = (self.bodies == body) & (self.kinds != 0)
        mine = self.triangles[is_mine]
        # Balls at the middles of some triangles often suffice.
        some = np.random.default_rng(1).permutation(np.flatnonzero(is_mine))[:24]
        for triangle in some:
            middle, inwards = self.triangles[triangle].mean(0), -self.normals[triangle]
            depths = geometry.ball_diameters(middle[None], inwards, mine, 4 * self.half_extent, 2 * self.resolution)[0]
            centre = middle + depths[0] / 2 * inwards
            radius = geometry.distances_to_surface(centre[None], mine)[0]
            if 2 * radius >= enough and self.windings(centre[None])[0] > 0.5:
                return 2 * float(radius), np.inf
        low, high = mine.reshape(-1, 3).min(0), mine.reshape(-1, 3).max(0)
        size = float((high - low).min())
        counts = np.maximum(1, np.minimum(np.ceil((high - low) / size), 40)).astype(int)
        edges = (high - low) / counts
        cells = np.stack(np.meshgrid(*(np.arange(count) for count in counts), indexing="ij"), -1).reshape(-1, 3)
        centres, half = low + (cells + 0.5) * edges, edges / 2
        found, bound = 0.0, np.inf
        for _ in range(14):
            distances = geometry.distances_to_surface(centres, mine)
            signed = np.where(self.windings(centres) > 0.5, distances, -distances)
            found = max(found, 2 * float(signed.max()))
            bounds = 2 * (signed + np.linalg.norm(half))
            bound = max(found, float(bounds.max()))
            centres = centres[bounds > max(enough, found)]
            if len(centres) == 0:
                return found, max(found, enough)
            if found >= enough or len(centres) > 30_000:
                break
            half = half / 2
            offsets = np.stack(np.meshgrid(*([-1, 1],) * 3, indexing="ij"), -1).reshape(-1, 3) * half
            centres = (centres[:, None] + offsets).reshape(-1, 3)
        return found, bound
