#include "trace/tracer_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "asdf_vk/report.h"
#include "trace/reference_tracer.h"

namespace asdfvk {
namespace {

constexpr size_t kFaceCount = 64;

}  // namespace

TracerCheck checkTracer(ConeTracer& tracer, const TraceScene& scene, const Cone& cone) {
  const std::span<const uint32_t> traceable = scene.bvh.primitiveFaces;
  std::vector<uint32_t> faces(std::min(kFaceCount, traceable.size()));
  for (size_t i = 0; i < faces.size(); ++i) faces[i] = traceable[i * traceable.size() / faces.size()];
  std::vector<double> values(faces.size()), expected(faces.size());
  tracer.trace(faces, {values, {}}, {});
  makeReferenceTracer(scene, cone)->trace(faces, {expected, {}}, {});
  return compareValues(values, expected, scene.geometry.bounds.diagonal());
}

TracerCheck compareValues(std::span<const double> values, std::span<const double> expected, double diagonal) {
  TracerCheck check;
  for (size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]) && std::isnan(expected[i])) continue;
    ++check.comparedCount;
    if (!(std::abs(values[i] - expected[i]) <= kAgreementTolerance * diagonal)) ++check.differingCount;
  }
  return check;
}

}  // namespace asdfvk
