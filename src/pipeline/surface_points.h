#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/run_control.h"
#include "core/function_ref.h"
#include "core/vec3.h"
#include "pipeline/judged_surface.h"
#include "pipeline/prepared_scene.h"
#include "trace/nearest_hit.h"
#include "trace/nearest_point.h"

namespace asdfvk {

/// Calls take(i, p) for each point i with the nearest surface point p, in parallel. p.face is kNoFace if no triangle
/// has an area. points: in the unit of the mesh.
void findNearestPoints(const PreparedScene& scene, std::span<const Vec3d> points, const RunControl& control,
                       FunctionRef<void(size_t, const SurfacePoint&)> take);

/// The same with the nearest point at which the normal of the surface differs by less than 90 degrees from normals[i].
/// The search ignores faces without an area.
void findNearestPoints(const PreparedScene& scene, std::span<const Vec3d> points, std::span<const Vec3d> normals,
                       const RunControl& control, FunctionRef<void(size_t, const SurfacePoint&)> take);

/// Whether the surface is oriented away from a point: whether it is behind its nearest face. At a vertex, where several
/// faces are equally near and the surface may be a saddle, the first face on the way to the nearest one decides. point:
/// in the unit of the mesh, in its bounding box.
[[nodiscard]] bool isBehindSurface(const PreparedScene& scene, const Vec3d& point, const SurfacePoint& nearest);

/// See Scene::firstHits(). directions: unit. RayHit::face is a triangle or kNoFace.
[[nodiscard]] std::vector<RayHit> findFirstHits(const PreparedScene& scene, std::span<const Vec3d> origins,
                                                std::span<const Vec3d> directions, const RunControl& control);

/// A thickness is exact (low = high), unless it is capped: no wall limits it, but the greatest section of the solid.
/// Then low is the diameter of the greatest ball that was found, and high the bound of all balls.
struct ThicknessRange {
  double low = 0, high = 0;
  bool isCapped = false;
};

/// The thickness at points of faces of the surface. faces: the face of each point, or kNoFace for no value.
[[nodiscard]] std::vector<ThicknessRange> thicknessRangesAt(const JudgedSurface& surface, std::span<const Vec3d> points,
                                                            std::span<const Vec3d> normals,
                                                            std::span<const uint32_t> faces,
                                                            const ThicknessOptions& options, const RunControl& control);

/// See Scene::thicknessAt(). normals: unit.
[[nodiscard]] std::vector<double> thicknessAtPoints(const JudgedSurface& surface, std::span<const Vec3d> points,
                                                    std::span<const Vec3d> normals, const ThicknessOptions& options,
                                                    const RunControl& control);

}  // namespace asdfvk
