#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asdf_vk/run_control.h"
#include "core/vec3.h"
#include "segment/part_surface.h"

namespace asdfvk {

inline constexpr uint32_t kNoPatch = 0xffffffff;

/// Connected pieces of the surface of about equal size. Borders prefer concave edges and changes of the values.
struct Patches {
  std::vector<uint32_t> patchOf;  ///< #F, below `count`; kNoPatch for faces that no seed reaches.
  uint32_t count = 0;
};

/// Patches around the farthest points of the surface, improved by two rounds of Lloyd's method. In each round, the new
/// seed of a patch is the face of the patch that is farthest from its border. Distances are along
/// PartSurface::creasedArcs. firstSeeds: one face of each component that is divided, at least one in all. counts:
/// ascending; the result has the patches for each count. Meshes with fewer faces than a count have fewer patches. There
/// is at least one patch per first seed. Deterministic; the counts are processed in parallel. For a larger count, the
/// list of farthest points begins with the list for the next smaller count. Throws Error{Cancelled}.
[[nodiscard]] std::vector<Patches> makePatches(const PartSurface& surface, std::span<const uint32_t> firstSeeds,
                                               std::span<const uint32_t> counts, const RunControl& stopOnly = {});

/// Data of patches for the merging. Lengths and areas as in PartSurface.
struct PatchData {
  struct Patch {
    double area = 0;
    double logValue = 0;      ///< Mean, weighted by area.
    Vec3d centre;             ///< Mean, weighted by area.
    Vec3d normal;             ///< A unit vector, or 0.
    uint32_t centreFace = 0;  ///< The face of the patch that is nearest to `centre`.
  };
  /// Two adjacent patches a < b. Sums are over the edges between a and b.
  struct Border {
    uint32_t a = 0, b = 0;
    double length = 0;
    double concave = 0, convex = 0;  ///< Length times angle in radians.
  };
  std::vector<Patch> patches;
  std::vector<Border> borders;  ///< Ascending by (a, b).
};

[[nodiscard]] PatchData describePatches(const PartSurface& surface, std::span<const Vec3d> normals,
                                        const Patches& patches);

}  // namespace asdfvk
