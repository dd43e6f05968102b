#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/face_domain.h"
#include "pipeline/prepared_mesh.h"

namespace asdfvk {

/// Input faces of a mesh. Views only.
struct InputFaceSet {
  std::span<const uint8_t> flags = {};  ///< #I, nonzero = in the set; empty: all are.

  [[nodiscard]] bool hasAll() const { return flags.empty(); }
  [[nodiscard]] bool contains(uint64_t inputFace) const { return flags.empty() || flags[inputFace] != 0; }
};

[[nodiscard]] FaceDomain wholeMesh(const PreparedMesh& prepared);

/// The domain of the faces of a region. The mesh and `inputFaces` must outlive this object.
class Region {
 public:
  Region(const PreparedMesh& prepared, const InputFaceSet& inputFaces);

  [[nodiscard]] const InputFaceSet& inputFaces() const { return inputFaces_; }
  [[nodiscard]] FaceDomain domain() const {
    return {graph_, geometry_, componentOf_, componentCount_, traceable_, faces_};
  }

 private:
  void connect(const PreparedMesh& prepared, std::span<const uint32_t> nodeOf);
  void labelComponents();

  InputFaceSet inputFaces_;
  std::vector<uint32_t> faces_;
  DualGraph graph_;
  FaceGeometry geometry_;
  std::vector<uint32_t> componentOf_;
  size_t componentCount_ = 0;
  std::vector<uint32_t> traceable_;
};

/// Returns no region if `inputFaces` is empty or has all faces. Throws Error{ArraySize} if its size is not #I, and
/// Error{EmptyMesh} for a region without a face.
[[nodiscard]] std::optional<Region> regionOf(const PreparedMesh& prepared, std::span<const uint8_t> inputFaces);

}  // namespace asdfvk
