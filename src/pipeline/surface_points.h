#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/options.h"
#include "asdf_vk/run_control.h"
#include "core/vec3.h"
#include "pipeline/prepared_scene.h"

namespace asdfvk {

/// The triangle nearest to each point; kNoFace without a triangle that has an area. points: in the unit of the mesh.
[[nodiscard]] std::vector<uint32_t> nearestTriangles(const PreparedScene& scene, std::span<const Vec3d> points,
                                                     const RunControl& control);

/// See Scene::thicknessAt(). normals: unit.
[[nodiscard]] std::vector<double> thicknessAtPoints(const PreparedScene& scene, std::span<const Vec3d> points,
                                                    std::span<const Vec3d> normals, const ThicknessOptions& options,
                                                    const RunControl& control);

}  // namespace asdfvk
