"""Many queries on one mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import float_points, mask_array, mesh_argument, pairs_array
from ._compute import computed, method_of, skeleton_of, split_progress, values_of, with_diameter
from ._errors import error_of
from ._info import Info, info_of
from ._options import BackendOptions, ConeOptions, PointOptions, Progress, SceneOptions, checked_progress
from ._session import session_of

if TYPE_CHECKING:
    from typing_extensions import Unpack


class Scene:
    """A mesh that is prepared once for many queries. Keeps geometry, bounding-volume hierarchy and tracers.

    vertices, faces: as for shape_diameter(). Arrays are copied.
    orient: "keep", "auto" (reverse inverted closed components) or "flip" (reverse all faces).
    options: session, or backend, device, require_gpu and threads.

    `faces=` of the methods selects a region: a mask, (m,) bool, or indices of faces. Only faces of the region cast rays
    and get values. Rays can hit all faces of the mesh. Any number of threads may use a scene. A session runs one
    computation at a time.
    """

    def __init__(
        self,
        vertices: Any,
        faces: ArrayLike | None = None,
        *,
        orient: Literal["keep", "auto", "flip"] | None = "keep",
        progress: Progress | None = None,
        **options: Unpack[BackendOptions],
    ) -> None:
        settings: dict[str, Any] = dict(options)
        session = session_of(settings)
        split_progress(settings, ())
        mesh = mesh_argument(vertices, faces)
        if isinstance(mesh, tuple):  # The scene copies the arrays, because the caller may change them after this call.
            mesh = mesh[0].copy(), mesh[1].copy()
        self._open: _core.Scene | None = _core.Scene(
            session._opened, mesh, {"orient": orient}, checked_progress(progress)
        )
        self.face_count: int = mesh.face_count if isinstance(mesh, _core.Mesh) else len(mesh[1])
        """Number of faces. Functions return a value for each face."""

    def close(self) -> None:
        """Releases the memory of the scene."""
        self._open = None

    def __enter__(self) -> Scene:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<asdf_vk.Scene, {'closed' if self._open is None else f'{self.face_count} faces'}>"

    @property
    def _opened(self) -> _core.Scene:
        if self._open is None:
            raise error_of("optionConflict", "the scene is closed")
        return self._open

    def at(self, points: ArrayLike, normals: ArrayLike, **options: Unpack[PointOptions]) -> NDArray[np.float32]:
        """Shape diameter at points. The cone of rays at a point has the reversed normal as axis.

        points: (k, 3), on the surface or inside. normals: (k, 3), outwards, of any length above 0.
        options: definition, rays, cone_angle, false_hit_angle, outlier_deviations, cone_rotation, progress.

        Returns float32 (k,), in the unit of the mesh. NaN means no value. Rays start below the point, at a depth of
        1e-5 of the diagonal of the bounding box. So they do not hit the surface at the point.
        """
        settings: dict[str, Any] = dict(options)
        progress = split_progress(settings, ConeOptions.__annotations__)
        return self._opened.values_at(*pairs_array(points, normals), settings, progress)

    def distance(self, points: ArrayLike, *, progress: Progress | None = None) -> NDArray[np.float64]:
        """Distance of each point to the nearest point of the surface. Points may be inside or outside of the shape.

        points: (k, 3). Returns float64 (k,), in the unit of the mesh, never negative. Ignores faces without an area.
        Raises InputError if a point is not finite or no face has an area.
        """
        return self._opened.distance(float_points(points), False, checked_progress(progress))

    def radii(self, points: ArrayLike, *, progress: Progress | None = None) -> NDArray[np.float64]:
        """Radii of the largest balls in the shape around given points, like asdf_vk.radii()."""
        return self._opened.distance(float_points(points), True, checked_progress(progress))

    def _computed(self, faces: ArrayLike | None, options: dict[str, Any], **implied: Any) -> _core.ComputedFields:
        scene = self._opened
        mask = None if faces is None else mask_array(faces, self.face_count)
        return computed(lambda own, progress: scene.compute(own, mask, progress), options, implied)

    def compute(self, *, faces: ArrayLike | None = None, **options: Unpack[SceneOptions]) -> Info:
        """Like asdf_vk.compute(), for the whole mesh or for a region (faces)."""
        return info_of(self._computed(faces, dict(options)))

    def compare(
        self, former: Scene, *, faces: ArrayLike | None = None, **options: Unpack[SceneOptions]
    ) -> Info:
        """Like asdf_vk.compare(), for the whole mesh or for a region (faces). former: the former version."""
        other = former._opened
        scene = self._opened
        mask = None if faces is None else mask_array(faces, self.face_count)
        given = dict(options)
        return info_of(computed(lambda own, progress: scene.compare(other, own, mask, progress), given, {}))

    def shape_diameter(
        self, *, faces: ArrayLike | None = None, **options: Unpack[SceneOptions]
    ) -> NDArray[np.float32]:
        """Like asdf_vk.shape_diameter(), for the whole mesh or for a region (faces)."""
        given = dict(options)
        return values_of(self._computed(faces, with_diameter(given)), "sdf", given)

    def thickness(self, *, faces: ArrayLike | None = None, **options: Unpack[SceneOptions]) -> NDArray[np.float32]:
        """Like asdf_vk.thickness(), for the whole mesh or for a region (faces)."""
        given = dict(options)
        return values_of(self._computed(faces, given, measure="thickness"), "thickness", given)

    def segment(
        self, *, method: Literal["parts", "cgal"] | None = "parts", **options: Unpack[SceneOptions]
    ) -> NDArray[np.int32]:
        """Like asdf_vk.segment(), for the whole mesh. Regions are not supported."""
        given = dict(options)
        return values_of(self._computed(None, given, segment=method_of(method)), "segment", given)

    def skeleton_points(
        self, *, faces: ArrayLike | None = None, **options: Unpack[SceneOptions]
    ) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
        """Like asdf_vk.skeleton_points(), for the whole mesh or for a region (faces)."""
        given = dict(options)
        return skeleton_of(self._computed(faces, given, centres=True), given)
