#include "io/corner_welder.h"

#include <bit>
#include <cmath>
#include <limits>

#include "mesh/coincident_faces.h"
#include "mesh/mesh.h"

namespace asdfvk {
namespace {

constexpr uint32_t kEmptySlot = std::numeric_limits<uint32_t>::max();

}  // namespace

CornerWelder::CornerWelder(uint64_t expectedPointCount) {
  resizeTable(std::bit_ceil(expectedPointCount + expectedPointCount / 2 + 16));
}

uint64_t CornerWelder::slotOf(const Vec3d& point) const {
  const uint64_t mask = table_.size() - 1;
  uint64_t slot = hashOf(point) & mask;
  while (table_[slot] != kEmptySlot && !(points_[table_[slot]] == point)) slot = (slot + 1) & mask;
  return slot;
}

uint32_t CornerWelder::indexOf(Vec3d point) {
  point = point + Vec3d{};  // Converts -0 to 0.
  const bool isNan = std::isnan(point.x) || std::isnan(point.y) || std::isnan(point.z);
  const uint64_t slot = isNan ? 0 : slotOf(point);
  if (!isNan && table_[slot] != kEmptySlot) return table_[slot];
  const auto index = static_cast<uint32_t>(points_.size());
  points_.push_back(point);
  requireAtMost(kMaxIndexCount, points_.size(), "vertices");
  if (!isNan) {
    table_[slot] = index;
    if (points_.size() * 3 > table_.size() * 2) resizeTable(table_.size() * 2);
  }
  return index;
}

void CornerWelder::resizeTable(uint64_t slotCount) {
  table_.assign(slotCount, kEmptySlot);
  for (uint32_t i = 0; i < points_.size(); ++i) {
    const Vec3d& p = points_[i];
    if (!std::isnan(p.x) && !std::isnan(p.y) && !std::isnan(p.z)) table_[slotOf(p)] = i;
  }
}

}  // namespace asdfvk
