#include "pipeline/thickness.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/interpolation.h"
#include "pipeline/seed_tracing.h"

namespace asdfvk {
namespace {

/// Grows a set of faces to trace, each face at most once.
class FacesToTrace {
 public:
  FacesToTrace(const Computation& computation, const FaceThickness& thickness)
      : graph_(computation.domain.graph), isSettled_(thickness.isTraced) {
    for (uint32_t face = 0; face < isSettled_.size(); ++face)
      if (computation.prepared.geometry.isDegenerate(face)) isSettled_[face] = 1;
  }

  void add(uint32_t face) {
    if (std::exchange(isSettled_[face], uint8_t{1}) == 0) faces_.push_back(face);
  }
  void addNeighboursOf(uint32_t face) {
    for (const uint32_t neighbour : graph_.neighboursOf(face)) add(neighbour);
  }
  /// Ascending.
  [[nodiscard]] std::vector<uint32_t> take() {
    std::sort(faces_.begin(), faces_.end());
    return std::exchange(faces_, {});
  }

 private:
  const DualGraph& graph_;
  std::vector<uint8_t> isSettled_;  // #F, 1: traced, to be traced, or degenerate.
  std::vector<uint32_t> faces_;
};

}  // namespace

bool verifiesThickness(const Computation& computation) {
  const Options& options = computation.options;
  return computation.measuresThickness() && options.thickness.thinnerThan && options.seeds.kind != SeedCount::Kind::All;
}

FaceThickness interpolateThickness(const Computation& computation, const TracedSeeds& traced,
                                   const RunControl& control) {
  FaceThickness thickness;
  thickness.isTraced = traced.isSeed;
  thickness.statistics = traced.thicknessStatistics;
  thickness.values = traced.thickness;
  if (thickness.values.empty()) thickness.values.assign(traced.values.size(), kNoValue);
  const std::span<const uint32_t> traceable = computation.domain.traceableFaces;
  if (std::all_of(traceable.begin(), traceable.end(), [&](uint32_t face) { return traced.isSeed[face] != 0; }))
    return thickness;
  Options harmonic = computation.options;
  harmonic.interpolation.guidance = Guidance::None;
  harmonic.interpolation.pooling = 0;
  const Computation withoutGuidance{harmonic,
                                    computation.prepared,
                                    computation.domain,
                                    computation.scene,
                                    computation.cone,
                                    computation.backend,
                                    computation.solvers,
                                    computation.clock,
                                    computation.warnings};
  const std::vector<double> interpolated = Interpolation(withoutGuidance).solve(thickness.values, control).values;
  for (const uint32_t face : traceable)
    if (traced.isSeed[face] == 0) thickness.values[face] = interpolated[face];
  return thickness;
}

void verifyThinRegions(const Computation& computation, SeedTracing& tracing, std::span<const double> expectedErrors,
                       FaceThickness& thickness, const RunControl& control) {
  const double limit = *computation.options.thickness.thinnerThan;
  FacesToTrace toTrace(computation, thickness);
  for (uint32_t face = 0; face < thickness.values.size(); ++face) {
    const double error = expectedErrors.empty() || thickness.isTraced[face] != 0 ? 0 : expectedErrors[face];
    if (!(thickness.values[face] - (std::isfinite(error) ? error : 0) < limit)) continue;
    toTrace.add(face);
    toTrace.addNeighboursOf(face);
  }
  TracedSeeds traced(thickness.values.size());
  for (std::vector<uint32_t> faces = toTrace.take(); !faces.empty(); faces = toTrace.take()) {
    {
      const auto scope = computation.clock.time(Stage::Trace);
      tracing.trace(faces, traced, control);
    }
    traced.hits.clear();
    for (const uint32_t face : faces) {
      thickness.values[face] = traced.thickness[face];
      thickness.isTraced[face] = 1;
      if (thickness.values[face] < limit) toTrace.addNeighboursOf(face);
    }
  }
  thickness.verifiedCount = traced.faces.size();
  thickness.rays = traced.statistics;
  thickness.statistics.unrefinedCount += traced.thicknessStatistics.unrefinedCount;
  thickness.statistics.redoneBallCount += traced.thicknessStatistics.redoneBallCount;
}

std::vector<double> thicknessOfInputFaces(const TriangleMesh& mesh, std::span<const double> values) {
  if (mesh.polygons.isEmpty()) return {values.begin(), values.end()};
  std::vector<double> least(mesh.inputFaceCount(), kNoValue);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    double& value = least[mesh.inputFaceOf(face)];
    if (!(value <= values[face]) && !std::isnan(values[face])) value = values[face];
  }
  return least;
}

}  // namespace asdfvk
