#include "seeds/disk_radius.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/random.h"
#include "seeds/surface_ball.h"
#include "seeds/surface_metric.h"

namespace asdfvk {

float estimateDiskRadius(const DualGraph& graph, std::span<const float> arcLengths,
                         std::span<const uint32_t> candidates, uint64_t count, uint64_t randomSeed) {
  ASDFVK_CHECK(!candidates.empty());
  ASDFVK_CHECK_OP(count, >, 0u);
  constexpr double kFacesInDiskPerFacePerCentre = 2.2;
  constexpr double kMaxSampleCount = 256;
  const double candidateCount = static_cast<double>(candidates.size());
  const double wantedFaceCount = 1 + kFacesInDiskPerFacePerCentre * candidateCount / static_cast<double>(count);
  const double sampleCount = std::floor(std::clamp(candidateCount / wantedFaceCount, 1.0, kMaxSampleCount));
  Random random(randomSeed);
  SurfaceBall ball(graph, arcLengths);
  double squaredRadii = 0;
  for (int sample = 0; sample < sampleCount; ++sample) {
    ball.startAt(candidates[random.index(static_cast<uint32_t>(candidates.size()))]);
    SurfaceBall::Member member;
    double faceCount = 0;
    while (faceCount < wantedFaceCount && ball.next(member)) ++faceCount;
    // A component smaller than the disk counts as if the surface went on.
    squaredRadii += double{member.distance} * double{member.distance} * wantedFaceCount / faceCount;
  }
  return std::max(kShortestArc, static_cast<float>(std::sqrt(squaredRadii / sampleCount)));
}

}  // namespace asdfvk
