#include "seeds/surface_metric.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/median.h"
#include "mesh/dihedral.h"

namespace asdfvk {
namespace {

// NaN, from coordinates beyond what a double can square, becomes the longest arc.
float arcOf(double length) {
  return std::max(kShortestArc, length < kLongestArc ? static_cast<float>(length) : kLongestArc);
}

template <typename LengthOf>
std::vector<float> forEachArc(const DualGraph& graph, const LengthOf& lengthOf) {
  std::vector<float> lengths(graph.neighbours.size());
  tbb::parallel_for(tbb::blocked_range<uint32_t>(0, graph.faceCount(), 4096), [&](const auto& range) {
    for (uint32_t face = range.begin(); face != range.end(); ++face)
      for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc)
        lengths[arc] = arcOf(lengthOf(face, graph.neighbours[arc]));
  });
  return lengths;
}

double medianStep(const DualGraph& graph, const FaceGeometry& geometry) {
  std::vector<double> steps;
  steps.reserve(graph.neighbours.size() / 2);
  for (uint32_t face = 0; face < graph.faceCount(); ++face)
    for (uint32_t neighbour : graph.neighboursOf(face))
      if (face < neighbour) steps.push_back(length(geometry.barycentres[neighbour] - geometry.barycentres[face]));
  std::erase_if(steps, [](double step) { return !std::isfinite(step); });
  const double median = steps.empty() ? 0 : upperMedian(steps);
  return median > 0 ? median : 1;
}

double angleStep(double signedAngleRadians) {
  constexpr double kRadians = std::numbers::pi / 180;
  const double scale = (signedAngleRadians > 0 ? kConcaveAngleDegrees : kConvexAngleDegrees) * kRadians;
  const double bend = signedAngleRadians / scale;
  return std::sqrt(1 + bend * bend);
}

}  // namespace

std::vector<float> arcLengths(const DualGraph& graph, const FaceGeometry& geometry, SurfaceMetric metric) {
  ASDFVK_CHECK_OP(geometry.areas.size(), ==, graph.faceCount());
  switch (metric) {
    case SurfaceMetric::Hops:
      return std::vector<float>(graph.neighbours.size(), 1.0f);
    case SurfaceMetric::Length: {
      const double median = medianStep(graph, geometry);
      return forEachArc(graph, [&](uint32_t face, uint32_t neighbour) {
        return length(geometry.barycentres[neighbour] - geometry.barycentres[face]) / median;
      });
    }
    case SurfaceMetric::Angle:
      return forEachArc(graph, [&](uint32_t face, uint32_t neighbour) {
        return angleStep(signedDihedralAngle(geometry, face, neighbour));
      });
  }
  ASDFVK_CHECK(!"a metric that exists");
  return {};
}

}  // namespace asdfvk
