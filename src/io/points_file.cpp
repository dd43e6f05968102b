// Skeleton points as a binary PLY of the element `vertex`: x y z, float radius, and uint part where there are segments.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "core/atomic_file.h"
#include "core/vec3.h"

namespace asdfvk {
namespace {

// Points are float where this is their resolution at least, relative to the diagonal of their box, else double.
constexpr double kFloatResolution = 1e-6;

/// Centres, values and parts of the faces with a value.
struct Points {
  std::vector<Vec3d> centres;
  std::vector<float> radii;
  std::vector<uint32_t> parts;  ///< Empty without segments.
  bool hasParts = false;

  explicit Points(std::span<const Field> fields) {
    const Field &centre = requireField(fields, "centre"), &sdf = requireField(fields, "sdf");
    const Field* const segment = findField(fields, "segment", FieldLocation::PerFace);
    const size_t faceCount = sdf.size();
    const auto fits = [faceCount](const Field& field, uint32_t componentCount) {
      return field.componentCount == componentCount && field.size() == faceCount * componentCount;
    };
    if (!fits(sdf, 1) || !fits(centre, 3) || (segment != nullptr && !fits(*segment, 1)))
      throw Error(ErrorCode::OptionConflict, "the sizes of the fields centre, sdf and segment do not fit each other");
    if (sdf.reals() != nullptr) requireSingles(*sdf.reals(), "'sdf'");
    for (size_t face = 0; face < faceCount; ++face) {
      const Vec3d point{centre.at(3 * face), centre.at(3 * face + 1), centre.at(3 * face + 2)};
      if (!std::isfinite(sdf.at(face)) || !isFinite(point)) continue;
      centres.push_back(point);
      radii.push_back(static_cast<float>(sdf.at(face) / 2));
      if (segment != nullptr) parts.push_back(static_cast<uint32_t>(segment->at(face)));
    }
    hasParts = segment != nullptr;
  }

  [[nodiscard]] bool fitFloat() const {
    Vec3d low, high;
    double largest = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::numeric_limits<double>::max();
      high[axis] = std::numeric_limits<double>::lowest();
      for (const Vec3d& point : centres) {
        low[axis] = std::min(low[axis], point[axis]);
        high[axis] = std::max(high[axis], point[axis]);
        largest = std::max(largest, std::abs(point[axis]));
      }
    }
    if (centres.empty()) return true;
    using Limits = std::numeric_limits<float>;
    const double resolution = kFloatResolution * std::hypot(high.x - low.x, high.y - low.y, high.z - low.z);
    return largest <= Limits::max() && Limits::min() <= resolution && largest * Limits::epsilon() <= resolution;
  }
};

template <typename T>
void writeRows(AtomicFile& file, const Points& points) {
  for (size_t i = 0; i < points.centres.size(); ++i) {
    for (size_t axis = 0; axis < 3; ++axis) file.put(static_cast<T>(points.centres[i][axis]));
    file.put(points.radii[i]);
    if (points.hasParts) file.put(points.parts[i]);
  }
}

}  // namespace

void writePoints(const std::filesystem::path& path, std::span<const Field> fields) {
  const Points points(fields);
  const bool isFloat = points.fitFloat();
  AtomicFile file(path);
  const char* const type = isFloat ? "float" : "double";
  file.write(fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment asdf-vk: skeleton points, radius is half of the shape diameter\n"
      "element vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\nproperty float radius\n{}end_header\n",
      points.centres.size(), type, type, type, points.hasParts ? "property uint part\n" : ""));
  isFloat ? writeRows<float>(file, points) : writeRows<double>(file, points);
  file.commit();
}

}  // namespace asdfvk
