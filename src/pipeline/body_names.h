#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asdf_vk/report.h"
#include "pipeline/judged_surface.h"
#include "pipeline/region.h"

namespace asdfvk {

/// Names of the bodies of a surface in reports.
class BodyNames {
 public:
  /// surface: must outlive this object.
  explicit BodyNames(const JudgedSurface& surface);

  /// The names of the bodies of two triangles of the mesh, one name if they are equal. Empty if the mesh has one body
  /// without a name.
  [[nodiscard]] std::vector<std::string> of(uint32_t triangle, uint32_t other) const;
  /// The same for an input face of the mesh: one name, or none.
  [[nodiscard]] std::vector<std::string> ofInputFace(uint64_t face) const;
  /// For each group of faces, the names of their bodies, each body once. faces: the surface, or that of the space.
  /// groupOf: for each of its faces the group, or kNoFace.
  [[nodiscard]] std::vector<std::vector<std::string>> ofGroups(const JudgedSurface& faces,
                                                               std::span<const uint32_t> groupOf,
                                                               size_t groupCount) const;
  /// Contacts of bodies of which at least one has a face in the region.
  [[nodiscard]] std::vector<BodyContact> contacts(const InputFaceSet& region) const;

 private:
  [[nodiscard]] std::string nameOf(uint32_t triangle) const;

  const JudgedSurface& surface_;
  bool isPlain_ = false;
};

}  // namespace asdfvk
