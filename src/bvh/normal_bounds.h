#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bvh/bvh.h"
#include "mesh/face_geometry.h"
#include "shared/bvh_layout.h"

namespace asdfvk {

/// Bounds of the normals of some triangles, in the bits of one word: see kNormalBoundsBits in shared/bvh_layout.h.
struct NormalBounds {
  uint32_t bits = kNoNormals;

  void add(const Vec3d& normal);
  void add(const NormalBounds& other);
};

/// Whether a normal within the bounds may have at most a given cosine with a unit vector; conservative.
class NormalBoundsTest {
 public:
  NormalBoundsTest(const Vec3d& normal, double cosine);

  [[nodiscard]] bool mayHold(NormalBounds bounds) const {
    const auto component = [&](size_t axis) {
      return factors_[axis] * static_cast<double>(bounds.bits >> shifts_[axis] & kNormalBoundsMask);
    };
    return component(0) + component(1) + component(2) <= limit_;
  }

 private:
  Vec3d factors_;
  Vec3<uint32_t> shifts_;
  double limit_;
};

/// Of the triangles below each node of the hierarchy, in the order of Bvh::nodes.
[[nodiscard]] std::vector<NormalBounds> normalBoundsOf(const Bvh& bvh, const FaceGeometry& geometry);

}  // namespace asdfvk
