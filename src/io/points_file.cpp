// Skeleton points as a binary PLY of the element `vertex`: double x y z, float radius, and uint part where there are
// segments.
#include <fmt/core.h>

#include <cmath>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "core/atomic_file.h"

namespace asdfvk {

void writePoints(const std::filesystem::path& path, std::span<const Field> fields) {
  const Field &centre = requireField(fields, "centre"), &sdf = requireField(fields, "sdf");
  const Field* const segment = findField(fields, "segment", FieldLocation::PerFace);
  const auto fits = [&](const Field& field, uint32_t componentCount) {
    return field.componentCount == componentCount && field.size() == sdf.size() * componentCount;
  };
  if (!fits(sdf, 1) || !fits(centre, 3) || (segment != nullptr && !fits(*segment, 1)))
    throw Error(ErrorCode::OptionConflict, "the sizes of the fields centre, sdf and segment do not fit each other");
  if (sdf.reals() != nullptr) requireSingles(*sdf.reals(), "'sdf'");
  std::vector<size_t> faces;  // Faces with a point.
  for (size_t face = 0; face < sdf.size(); ++face)
    if (std::isfinite(sdf.at(face)) && std::isfinite(centre.at(3 * face)) && std::isfinite(centre.at(3 * face + 1)) &&
        std::isfinite(centre.at(3 * face + 2)))
      faces.push_back(face);
  AtomicFile file(path);
  file.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment asdf-vk: skeleton points, radius is half of the shape diameter\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\nproperty float radius\n"
      "{}end_header\n",
      faces.size(), segment != nullptr ? "property uint part\n" : ""));
  for (const size_t face : faces) {
    for (size_t axis = 0; axis < 3; ++axis) file.put(centre.at(3 * face + axis));
    file.put(static_cast<float>(sdf.at(face) / 2));
    if (segment != nullptr) file.put(static_cast<uint32_t>(segment->at(face)));
  }
  file.commit();
}

}  // namespace asdfvk
