#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/run_control.h"
#include "core/function_ref.h"
#include "core/vec3.h"
#include "pipeline/prepared_scene.h"
#include "trace/nearest_hit.h"
#include "trace/nearest_point.h"

namespace asdfvk {

/// Calls take(i, p) with the surface point p nearest to each point i, in parallel; p.face is kNoFace where no triangle
/// has an area. points: in the unit of the mesh.
void findNearestPoints(const PreparedScene& scene, std::span<const Vec3d> points, const RunControl& control,
                       FunctionRef<void(size_t, const SurfacePoint&)> take);

/// See Scene::firstHits(). Directions are unit; kNoFace and faces are those of triangles.
[[nodiscard]] std::vector<RayHit> findFirstHits(const PreparedScene& scene, std::span<const Vec3d> origins,
                                                std::span<const Vec3d> directions, const RunControl& control);

/// See Scene::thicknessAt(). normals: unit.
[[nodiscard]] std::vector<double> thicknessAtPoints(const PreparedScene& scene, std::span<const Vec3d> points,
                                                    std::span<const Vec3d> normals, const ThicknessOptions& options,
                                                    const RunControl& control);

}  // namespace asdfvk
