"""Distances, balls and winding numbers of triangles, by brute force. Arrays: points (p, 3), triangles (t, 3, 3)."""

from __future__ import annotations

import numpy as np

CHUNK = 160_000  # Pairs of points and triangles that are in memory at once.


def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return (a * b).sum(-1)


def area_vectors(triangles: np.ndarray) -> np.ndarray:
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2


def unit_normals(triangles: np.ndarray) -> np.ndarray:
    """Zero for triangles without area, or with a corner that is not finite."""
    vectors = np.nan_to_num(area_vectors(triangles), nan=0, posinf=0, neginf=0)
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0)


def _on_segment(points: np.ndarray, start: np.ndarray, along: np.ndarray) -> np.ndarray:
    square = np.maximum(dot(along, along), 1e-300)
    return start + np.clip(dot(points - start, along) / square, 0, 1)[..., None] * along


def nearest_on_triangles(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """(p, t, 3): the point of each triangle that is nearest to each point: its projection, or a point of an edge."""
    origin = triangles.reshape(-1, 3).mean(0)  # Against rounding far from the origin.
    p, corners = points - origin, triangles - origin
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    squares = np.maximum(dot(normals, normals), 1e-300)
    is_inside = np.broadcast_to(dot(normals, normals) > 1e-280, (len(p), len(corners))).copy()
    shares, lengths = [], []
    for k in range(3):
        start, along = corners[:, k], corners[:, (k + 1) % 3] - corners[:, k]
        inwards = np.cross(normals, along)
        is_inside &= p @ inwards.T >= dot(start, inwards)
        square = np.maximum(dot(along, along), 1e-300)
        projection = p @ along.T - dot(start, along)
        share = np.clip(projection / square, 0, 1)
        # The squared distance without that from the start of the edge is exact enough to choose an edge.
        from_start = dot(p, p)[:, None] - 2 * p @ start.T + dot(start, start)
        shares.append(share)
        lengths.append(from_start + share * (share * square - 2 * projection))
    edge = np.argmin(np.stack(lengths), 0)
    share = np.choose(edge, shares)[..., None]
    each = np.arange(len(corners))
    start, end = corners[each, edge], corners[each, (edge + 1) % 3]
    on_edge = start + share * (end - start)
    heights = (p @ normals.T - dot(corners[:, 0], normals)) / squares
    projected = p[:, None] - heights[..., None] * normals
    return np.where(is_inside[..., None], projected, on_edge) + origin


def distances_to_surface(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """(p,): the distance of each point from the nearest triangle."""
    step = max(1, CHUNK // max(1, len(triangles)))
    parts = [np.linalg.norm(nearest_on_triangles(points[i:i + step], triangles) - points[i:i + step, None], axis=2).min(1)
             for i in range(0, len(points), step)]
    return np.concatenate(parts) if parts else np.zeros(0)


def ball_diameters(points: np.ndarray, inwards: np.ndarray, triangles: np.ndarray, cap: float,
                   least_depth: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The greatest balls that touch points and hold no point of the triangles.

    points: of one plane, whose unit normal towards the balls is `inwards`. Returns the diameters, at most `cap`, the
    points that limit them (NaN where nothing does), and the indices of their triangles (-1). A ball through q has the
    diameter |v|^2 / (v . m), v = q - p. The nearest point of a triangle to the centre of a ball gives a smaller ball,
    until no triangle is inside.
    """
    diameters, limits = np.full(len(points), cap), np.full((len(points), 3), np.nan)
    walls = np.full(len(points), -1)
    step = max(1, CHUNK // max(1, len(triangles)))
    for begin in range(0, len(points), step) if len(triangles) else ():
        active = np.arange(begin, min(begin + step, len(points)))
        for _ in range(200):
            p, d = points[active], diameters[active]
            nearest = nearest_on_triangles(p + d[:, None] / 2 * inwards, triangles)
            v = nearest - p[:, None]
            depth = v @ inwards
            with np.errstate(divide="ignore", invalid="ignore"):
                through = np.where(depth > least_depth, dot(v, v) / depth, np.inf)
            best = through.argmin(1)
            least = through[np.arange(len(active)), best]
            shrinks = least < d * (1 - 1e-9)
            active, best, least = active[shrinks], best[shrinks], least[shrinks]
            if len(active) == 0:
                break
            diameters[active], limits[active], walls[active] = least, nearest[shrinks, best], best
    return diameters, limits, walls


def winding_numbers(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """(p,): the sum of the solid angles of all triangles, over 4 pi. Van Oosterom and Strackee 1983."""
    result = np.zeros(len(points))
    step = max(1, CHUNK // 8 // max(1, len(triangles)))
    corners = triangles.transpose(1, 2, 0)
    for i in range(0, len(points), step):
        a, b, c = (corners[k][:, None] - points[i:i + step].T[:, :, None] for k in range(3))
        la, lb, lc = (np.sqrt(x[0] ** 2 + x[1] ** 2 + x[2] ** 2) for x in (a, b, c))
        ab, bc, ca = (x[0] * y[0] + x[1] * y[1] + x[2] * y[2] for x, y in ((a, b), (b, c), (c, a)))
        numerator = (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                     a[2] * (b[0] * c[1] - b[1] * c[0]))
        result[i:i + step] = np.arctan2(numerator, la * lb * lc + ab * lc + bc * la + ca * lb).sum(1) / (2 * np.pi)
    return result


def points_on(triangle: np.ndarray, spacing: float) -> np.ndarray:
    """Rows of points inside the triangle, along its longest edge. Rows and their points are at most `spacing` apart."""
    lengths = [np.linalg.norm(triangle[(k + 1) % 3] - triangle[k]) for k in range(3)]
    k = int(np.argmax(lengths))
    height = np.linalg.norm(np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])) / lengths[k]
    row_count = int(np.ceil(height / spacing))
    rows = []
    for row in range(row_count + 1):
        share = row / row_count
        along = np.linspace(0, 1, int(np.ceil(lengths[k] * (1 - share) / spacing)) + 1)
        rows.append(np.stack([(1 - share) * (1 - along), (1 - share) * along, np.full(len(along), share)], 1))
    weights = np.concatenate(rows) * (1 - 3e-3) + 1e-3  # Not on the border, which belongs to several faces.
    return weights @ np.roll(triangle, -k, axis=0)


def disc_points(centre: np.ndarray, radius: float, triangle: np.ndarray, normal: np.ndarray,
                ring_count: int = 4) -> np.ndarray:
    """Points of a triangle within a distance of the centre: rings around the nearest point of its plane."""
    height = dot(centre - triangle[0], normal)
    if abs(height) >= radius:
        return np.zeros((0, 3))
    first = np.cross(normal, [1.0, 0, 0] if abs(normal[0]) < 0.7 else [0, 1.0, 0])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    angles = np.arange(4 * ring_count) * np.pi / (2 * ring_count)
    around = np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * second
    reach = np.sqrt(radius**2 - height**2)
    base = centre - height * normal
    rings = [base[None]] + [base + share * reach * around for share in np.arange(1, ring_count + 1) / ring_count]
    points = np.concatenate(rings)
    nearest = nearest_on_triangles(points, triangle[None])[:, 0]
    on_triangle = np.linalg.norm(nearest - points, axis=1) <= 1e-9 * radius
    # The nearest point of the triangle, and points near its edges and corners, where the surface may taper off.
    own = nearest_on_triangles(centre[None], triangle[None])[0, 0]
    if np.linalg.norm(own - centre) > radius:
        return points[on_triangle]
    edges = _on_segment(centre, triangle, np.roll(triangle, -1, axis=0) - triangle)
    edges = np.concatenate([edges, triangle])
    edges = edges[np.linalg.norm(edges - centre, axis=1) <= radius]
    return np.concatenate([points[on_triangle], own[None], edges + 0.2 * (own - edges)])
