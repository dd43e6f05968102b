"""Meshes and colours, computed apart from the page."""

import numpy

# The map of src/io/colour_map.cpp. MAPS has the ends and the middle of the other maps, from matplotlib.
VIRIDIS = [(68, 1, 84), (71, 45, 123), (59, 82, 139), (44, 114, 142), (33, 145, 140), (40, 174, 128), (94, 201, 98),
           (173, 220, 48), (253, 231, 37)]
MAPS = {"cividis": [(0, 34, 78), (124, 123, 120), (254, 232, 56)], "turbo": [(48, 18, 59), (164, 252, 60), (122, 4, 3)],
        "grey": [(20, 20, 20), (135, 135, 135), (250, 250, 250)]}


def viridis(value, low, high):
    position = min(max((value - low) / (high - low), 0), 1) * (len(VIRIDIS) - 1)
    return numpy.array([numpy.interp(position, range(len(VIRIDIS)), channel) for channel in zip(*VIRIDIS)])


def write_ply(path, vertices, faces):
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\n"
              f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    rows = numpy.empty(len(faces), [("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, faces
    with open(path, "wb") as file:
        file.write(header.encode() + vertices.astype("<f4").tobytes() + rows.tobytes())


def write_stl(path, boxes):
    """A solid box (low, high), and cavities in it, as an ASCII STL."""
    lines = ["solid boxes"]
    for inverted, (low, high) in enumerate(boxes):
        corner = lambda i: [(low, high)[i >> axis & 1][axis] for axis in range(3)]  # noqa: B023, E731
        for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            for face in ((a, b, c), (a, c, d)):
                lines.append("facet normal 0 0 0\nouter loop")
                lines += ["vertex %g %g %g" % tuple(corner(i)) for i in (face[::-1] if inverted else face)]
                lines.append("endloop\nendfacet")
    with open(path, "w") as file:
        file.write("\n".join([*lines, "endsolid boxes\n"]))


class Mesh:
    """Of a binary PLY file of the generator: points and triangles."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        header, body = data.split(b"end_header\n", 1)
        counts = [int(line.split()[2]) for line in header.decode().split("\n") if line.startswith("element")]
        number = "f8" if b"property double x" in header else "f4"
        self.vertices = numpy.frombuffer(body, f"<{number}", 3 * counts[0]).reshape(-1, 3).astype(float)
        start = 3 * counts[0] * int(number[1])
        fields = [("count", "u1"), ("corners", "<i4", 3)]
        words = [line.split() for line in header.decode().split("element face")[1].split("\n")[2:]]
        fields += [(name, {"float": "<f4", "int": "<i4"}[kind]) for _, kind, name in filter(None, words)]
        rows = numpy.frombuffer(body[start:], numpy.dtype(fields), counts[1])
        assert (rows["count"] == 3).all()
        self.faces = rows["corners"]
        self.low, self.high = self.vertices.min(0), self.vertices.max(0)
        self.radius = numpy.linalg.norm(self.high - self.low) / 2
        corners = self.vertices[self.faces]
        self.areas = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2

    def seen(self, x, y, right, up, towards):
        """Face nearest to the viewer at (x, y) along `right` and `up` from the centre of the box; -1 without one, or where
        the point is close to an edge."""
        centre = (self.low + self.high) / 2
        corners = (self.vertices - centre)[self.faces]
        flat = numpy.stack([corners @ right, corners @ up], 2)
        a, b, c = flat[:, 0], flat[:, 1], flat[:, 2]
        cross = lambda p, q: p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]  # noqa: E731
        area = cross(b - a, c - a)
        point = numpy.array([[x, y]])
        with numpy.errstate(all="ignore"):
            weights = numpy.stack([cross(b - point, c - point), cross(c - point, a - point), cross(a - point, b - point)], 1)
            weights /= area[:, None]
        inside = (weights > 0).all(1)
        if not inside.any():
            return -1
        depth = ((corners @ towards) * weights).sum(1)
        nearest = numpy.flatnonzero(inside)[numpy.argmax(depth[inside])]
        return int(nearest) if weights[nearest].min() > 0.15 else -1
