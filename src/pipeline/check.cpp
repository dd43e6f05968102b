#include "pipeline/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seeds/random_permutation.h"
#include "trace/reference_tracer.h"

namespace asdfvk {
namespace {

// Keeps the faces to check independent of the faces that were chosen as seeds with the same number.
constexpr uint64_t kCheckStream = 0x6368'6563'6b00'0000u;

/// Over the diagonal; 0 when neither side has a value, infinite when only one has.
double relativeDifference(double value, double reference, double diagonal) {
  if (std::isnan(value) || std::isnan(reference))
    return std::isnan(value) == std::isnan(reference) ? 0 : std::numeric_limits<double>::infinity();
  return std::abs(value - reference) / diagonal;
}

double medianOf(std::vector<double>& numbers) {
  if (numbers.empty()) return 0;
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

}  // namespace

CheckReport checkAgainstReference(const Mesh& mesh, const PreparedMesh& prepared, const TraceScene& scene,
                                  const Cone& cone, const TracedSeeds& traced, std::span<const double> values,
                                  uint64_t count, uint64_t randomSeed, const RunControl& control) {
  const std::vector<uint32_t> faces = randomPermutationSeeds(prepared.castableFaces, count, randomSeed ^ kCheckStream);
  std::vector<double> references(faces.size());
  makeReferenceTracer(scene, cone)->trace(faces, references, control);

  CheckReport report;
  const double diagonal = prepared.geometry.bounds.diagonal();
  std::vector<double> tracedDifferences;
  double low = std::numeric_limits<double>::infinity(), high = -low, errorSum = 0;
  uint64_t comparedCount = 0;
  for (size_t i = 0; i < faces.size(); ++i) {
    const uint32_t face = faces[i];
    if (traced.isSeed[face]) {
      const double difference = relativeDifference(traced.values[face], references[i], diagonal);
      tracedDifferences.push_back(difference);
      report.agreeingCount += difference <= kAgreementTolerance;
      if (report.tracedCount++ == 0 || difference > report.worstDifference) {
        report.worstDifference = difference;
        report.worstFace = mesh.polygons.isEmpty() ? face : mesh.polygons.inputFaceOf[face];
      }
    }
    if (std::isnan(references[i]) || std::isnan(values[face])) continue;
    low = std::min(low, references[i]);
    high = std::max(high, references[i]);
    const double error = std::abs(values[face] - references[i]);
    errorSum += error;
    report.maximumError = std::max(report.maximumError, error);
    ++comparedCount;
    report.interpolatedCount += !traced.isSeed[face];
  }
  report.medianDifference = medianOf(tracedDifferences);
  if (high > low) {
    report.averageError = errorSum / static_cast<double>(comparedCount) / (high - low);
    report.maximumError /= high - low;
  } else {
    report.maximumError = 0;
  }
  report.passed = report.tracedCount > 0 && static_cast<double>(report.agreeingCount) >=
                                                kAgreementShare * static_cast<double>(report.tracedCount);
  return report;
}

}  // namespace asdfvk
