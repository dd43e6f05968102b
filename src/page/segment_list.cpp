#include "page/segment_list.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "asdf_vk/session.h"
#include "core/check.h"
#include "core/median.h"

namespace asdfvk {

std::vector<PageSegment> listSegments(const TriangleMesh& mesh, std::span<const double> areas,
                                      std::span<const Vec3d> barycentres, std::span<const uint32_t> labels,
                                      std::span<const double> values) {
  ASDFVK_CHECK(labels.size() == mesh.inputFaceCount() && values.size() == labels.size());
  struct Members {
    PageSegment segment;
    std::vector<double> values;
  };
  std::map<uint32_t, Members> members;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const uint32_t inputFace = mesh.inputFaceOf(face), label = labels[inputFace];
    if (label == kNoSegment) continue;
    auto& [segment, ofSegment] = members[label];
    ++segment.faceCount;
    if (std::isfinite(values[inputFace])) ofSegment.push_back(values[inputFace]);
    if (!(areas[face] > 0)) continue;
    segment.area += areas[face];
    segment.centre += (barycentres[face] - segment.centre) * (areas[face] / segment.area);
  }
  std::vector<PageSegment> segments;
  for (auto& [label, member] : members) {
    member.segment.label = label;
    if (!member.values.empty()) member.segment.median = upperMedian(member.values);
    segments.push_back(member.segment);
  }
  return segments;
}

}  // namespace asdfvk
