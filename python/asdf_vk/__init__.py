"""Local thickness (shape diameter function) of triangle meshes, on Vulkan or the CPU: a value for each face.

    import asdf_vk
    values = asdf_vk.shape_diameter(vertices, faces)    # float32 (m,), in the unit of the mesh, NaN = no value
    labels = asdf_vk.segment(vertices, faces)           # int32 (m,)

`vertices` is a float array of shape (n, 3), and `faces` is an int array of shape (m, 3). Instead of the two arrays, you
can pass one object with these attributes, for example a trimesh.Trimesh.
"""

from __future__ import annotations

from ._core import version as __version__
from ._errors import (
    ArrayTypeError,
    CancelledError,
    DeviceError,
    Error,
    InputError,
    MeshWarning,
    OutputError,
    UsageError,
)
from ._files import Mesh, join_meshes, mesh_of_polygons, read_mesh, write, write_points
from ._functions import compare, compute, radii, segment, shape_diameter, skeleton_points, thickness
from ._info import Info
from ._scene import Scene
from ._session import Device, Session, close_default_sessions, devices

__all__ = [
    "ArrayTypeError",
    "CancelledError",
    "Device",
    "DeviceError",
    "Error",
    "Info",
    "InputError",
    "Mesh",
    "MeshWarning",
    "OutputError",
    "Scene",
    "Session",
    "UsageError",
    "__version__",
    "close_default_sessions",
    "compare",
    "compute",
    "devices",
    "join_meshes",
    "mesh_of_polygons",
    "radii",
    "read_mesh",
    "segment",
    "shape_diameter",
    "skeleton_points",
    "thickness",
    "write",
    "write_points",
]

for _name in __all__:  # Tracebacks and help() then name `asdf_vk`, the module that users import.
    if callable(globals()[_name]):
        globals()[_name].__module__ = __name__
