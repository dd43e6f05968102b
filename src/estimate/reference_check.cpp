#include "estimate/reference_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/median.h"
#include "core/parallel.h"
#include "seeds/random_permutation.h"

namespace asdfvk {
namespace {

// Random streams of the two samples, independent of the stream of the seed faces.
constexpr uint64_t kTracedStream = 0x6368'6563'6b00'0000u;
constexpr uint64_t kErrorStream = 0x6368'6563'6b00'0001u;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class References {
 public:
  References(std::vector<uint32_t> ascendingFaces, const TraceScene& scene, const Cone& cone, const RunControl& control)
      : faces_(std::move(ascendingFaces)), values_(faces_.size()) {
    makeReferenceTracer(scene, cone)->trace(faces_, {values_}, control);
  }

  /// Returns the reference value of a face. Precondition: the face is one of `ascendingFaces`.
  [[nodiscard]] double operator[](uint32_t face) const {
    return values_[static_cast<size_t>(std::lower_bound(faces_.begin(), faces_.end(), face) - faces_.begin())];
  }

 private:
  std::vector<uint32_t> faces_;
  std::vector<double> values_;
};

std::vector<uint32_t> unionOf(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
  std::vector<uint32_t> all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

/// Computes the part of the report about traced faces. traced: #F.
void compareTraced(CheckReport& report, const std::vector<uint32_t>& faces, std::span<const double> traced,
                   const References& references, double diagonal, const TriangleMesh& mesh) {
  std::vector<double> differences;
  for (const uint32_t face : faces) {
    const double value = traced[face], reference = references[face];
    if (std::isnan(value) && std::isnan(reference)) {
      ++report.noValueAgreeCount;
      continue;
    }
    const bool isOneSided = std::isnan(value) || std::isnan(reference);
    const double difference = isOneSided ? kInfinity : std::abs(value - reference) / diagonal;
    report.agreeingCount += difference <= kAgreementTolerance;
    if (differences.empty() || difference > report.worstDifference) {
      report.worstDifference = difference;
      report.worstFace = mesh.inputFaceOf(face);
    }
    differences.push_back(difference);
  }
  report.tracedCount = faces.size();
  report.medianDifference = differences.empty() ? 0 : upperMedian(differences);
  const auto allowed =
      std::max<uint64_t>(1, static_cast<uint64_t>(kAllowedMissShare * static_cast<double>(report.tracedCount)));
  report.passed = report.missCount() < report.tracedCount && report.missCount() <= allowed;
}

/// Computes the part of the report about all faces.
void measureErrors(CheckReport& report, const std::vector<uint32_t>& faces, const ComputedValues& computed,
                   const References& references) {
  double low = kInfinity, high = -kInfinity, sum = 0, interpolatedSum = 0;
  for (const uint32_t face : faces) {
    const double value = computed.values[face], reference = references[face];
    if (std::isnan(value) || std::isnan(reference)) continue;
    low = std::min(low, reference);
    high = std::max(high, reference);
    const double error = std::abs(value - reference);
    sum += error;
    report.maximumError = std::max(report.maximumError, error);
    ++report.comparedCount;
    if (computed.isSeed[face] != 0) continue;
    interpolatedSum += error;
    report.interpolatedMaximumError = std::max(report.interpolatedMaximumError, error);
    ++report.interpolatedCount;
  }
  if (!(high > low)) {  // The values have no range.
    report.maximumError = report.interpolatedMaximumError = 0;
    return;
  }
  const double range = high - low;
  report.averageError = sum / static_cast<double>(report.comparedCount) / range;
  report.maximumError /= range;
  report.interpolatedMaximumError /= range;
  if (report.interpolatedCount > 0)
    report.interpolatedAverageError = interpolatedSum / static_cast<double>(report.interpolatedCount) / range;
}

}  // namespace

CheckReport checkAgainstReference(const TraceScene& scene, const Cone& cone, std::span<const uint32_t> traceableFaces,
                                  const ComputedValues& computed, uint64_t count, uint64_t randomSeed,
                                  const RunControl& control) {
  CheckReport report;
  report.independent = !computed.tracedByReference;
  std::vector<uint32_t> tracedFaces;
  if (report.independent)
    tracedFaces = randomPermutationSeeds(
        selectInParallel(traceableFaces, [&](uint32_t face) { return computed.isSeed[face] != 0; }), count,
        randomSeed ^ kTracedStream);
  const std::vector<uint32_t> faces = randomPermutationSeeds(traceableFaces, count, randomSeed ^ kErrorStream);
  const References references(unionOf(tracedFaces, faces), scene, cone, control);
  if (report.independent)
    compareTraced(report, tracedFaces,
                  constraintsOf(computed.seeds, computed.values.size(), [](size_t) { return true; }), references,
                  scene.geometry.bounds.diagonal(), scene.mesh);
  measureErrors(report, faces, computed, references);
  return report;
}

}  // namespace asdfvk
