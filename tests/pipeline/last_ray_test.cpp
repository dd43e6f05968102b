#include "pipeline/seed_rounds.h"

#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "generate/shapes.h"
#include "trace/reference_tracer.h"

using namespace asdfvk;

namespace {

/// Counts calls and passes them on, until it is let go of.
class CountingTracer final : public ConeTracer {
 public:
  CountingTracer(const TraceScene& scene, const Cone& cone, uint32_t& callCount)
      : tracer_(makeReferenceTracer(scene, cone)), callCount_(callCount) {}

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    ++callCount_;
    return tracer_->trace(seedFaces, results, control);
  }

 private:
  std::unique_ptr<ConeTracer> tracer_;
  uint32_t& callCount_;
};

struct Outcome {
  uint32_t lastRayCount = 0;  ///< Calls of afterLastRay.
  uint32_t callCount = 0;     ///< Of the tracer.
  uint32_t callCountAtLastRay = 0;
  uint32_t roundCount = 0;
  uint64_t seedCount = 0, faceCount = 0;
};

Outcome run(const Options& options) {
  Mesh mesh = makeTorus(4000).mesh;
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  const Bvh bvh = buildBvh(mesh, prepared.geometry, prepared.representatives);
  const TraceScene scene{mesh, prepared.geometry, prepared.representatives, bvh};
  const Cone cone = makeCone(options.cone);
  ComputeBackend backend({.backend = Backend::Reference});
  std::vector<std::string> warnings;
  Outcome outcome;
  CountingTracer tracer(scene, cone, outcome.callCount);
  SeedTracing tracing(prepared, tracer, cone.directions.size(), true);
  Interpolation interpolation(prepared, scene, cone, options, backend, warnings);
  const Stopwatch clock;
  StageSeconds seconds;
  SeedRounds rounds(mesh, prepared, options, tracing, interpolation, clock, seconds, [&] {
    ++outcome.lastRayCount;
    outcome.callCountAtLastRay = outcome.callCount;
  });
  rounds.run({});
  outcome.faceCount = mesh.faces.size();
  outcome.roundCount = rounds.roundCount();
  outcome.seedCount = rounds.traced().faces.size();
  return outcome;
}

}  // namespace

TEST_CASE("the last ray is told of once, and none is cast after it, in one round and in two") {
  for (const bool isAdaptive : {false, true}) {
    CAPTURE(isAdaptive);
    Options options;
    if (isAdaptive) options.sampler = "adaptive";
    const Outcome outcome = run(options);
    CHECK(outcome.roundCount == (isAdaptive ? 2u : 1u));
    CHECK(outcome.lastRayCount == 1);
    CHECK(outcome.callCountAtLastRay == outcome.callCount);
    CHECK(outcome.callCount >= 3);  // Placed seeds, probes and scouts.
    CHECK(outcome.seedCount == (outcome.faceCount + 5) / 10);
  }
}

TEST_CASE("while further rounds may follow no ray is the last one") {
  Options options;
  options.rounds.maxError = 0.004;
  options.seeds.share = 0.02;
  const Outcome outcome = run(options);
  CHECK(outcome.roundCount > 1);
  CHECK(outcome.lastRayCount == 0);
}
