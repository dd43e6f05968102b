#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/face_patches.h"
#include "pipeline/face_domain.h"

namespace asdfvk {

/// The centres of the patches of a mesh, for an interpolation on fewer faces. The mesh must outlive this object.
class PatchedMesh {
 public:
  explicit PatchedMesh(const PreparedMesh& prepared);

  [[nodiscard]] FaceDomain domain() const {
    return {graph_, componentOf_, prepared_.components.components.size() + 1, traceableFaces_, {}, this};
  }
  [[nodiscard]] const FacePatches& patches() const { return patches_; }
  /// Replaces the values of the faces that are not centres, see spreadFromCentres().
  void spread(std::vector<double>& values) const {
    spreadFromCentres(prepared_.graph, prepared_.geometry, patches_, values);
  }

 private:
  const PreparedMesh& prepared_;
  FacePatches patches_;
  DualGraph graph_;  // The graph of the patches, with their centres as nodes.
  std::vector<uint32_t> componentOf_, traceableFaces_;
};

/// The patches for an interpolation from this number of seeds; none if they would not save time, or if the faces are
/// so large that their values differ much within a patch.
[[nodiscard]] std::unique_ptr<const PatchedMesh> patchesFor(const PreparedMesh& prepared, uint64_t seedCount);

}  // namespace asdfvk
