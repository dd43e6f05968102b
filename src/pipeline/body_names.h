#pragma once

#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/report.h"
#include "pipeline/judged_surface.h"

namespace asdfvk {

/// Names of the bodies of a surface in reports.
class BodyNames {
 public:
  /// surface: must outlive this object.
  explicit BodyNames(const JudgedSurface& surface);

  /// The names of the bodies of two triangles of the mesh, one name if they are equal. Empty if the mesh has one body
  /// without a name.
  [[nodiscard]] std::vector<std::string> of(uint32_t triangle, uint32_t other) const;
  /// The names of the bodies of all triangles, each body once. Triangles may repeat.
  [[nodiscard]] std::vector<std::string> ofAll(std::vector<uint32_t> triangles) const;
  [[nodiscard]] std::vector<BodyContact> contacts() const;

 private:
  [[nodiscard]] std::string nameOf(uint32_t triangle) const;

  const JudgedSurface& surface_;
  bool isPlain_ = false;
};

}  // namespace asdfvk
