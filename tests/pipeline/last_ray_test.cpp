#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "bvh/bvh.h"
#include "generate/shapes.h"
#include "pipeline/rounds.h"

using namespace asdfvk;

namespace {

enum class Event { Trace, Release, Solve };
using Events = std::vector<Event>;

/// The reference, with a record of its calls and of its end.
class RecordingTracer final : public ConeTracer {
 public:
  RecordingTracer(std::unique_ptr<ConeTracer> tracer, Events& events) : tracer_(std::move(tracer)), events_(events) {}
  ~RecordingTracer() override { events_.push_back(Event::Release); }

  TraceStatistics trace(std::span<const uint32_t> seedFaces, const ConeResults& results,
                        const RunControl& control) override {
    events_.push_back(Event::Trace);
    return tracer_->trace(seedFaces, results, control);
  }
  TraceStatistics traceAt(std::span<const ConeStart> starts, const ConeResults& results,
                          const RunControl& control) override {
    return tracer_->traceAt(starts, results, control);
  }

 private:
  std::unique_ptr<ConeTracer> tracer_;
  Events& events_;
};

class RecordingSolver final : public PoissonSolver {
 public:
  explicit RecordingSolver(Events& events) : solver_(makeCpuCgSolver(nullptr)), events_(events) {}

  std::unique_ptr<GraphSolver> onGraph(const DualGraph& graph, std::span<const double> weights) override {
    return std::make_unique<OnGraph>(solver_->onGraph(graph, weights), events_);
  }

 private:
  class OnGraph final : public GraphSolver {
   public:
    OnGraph(std::unique_ptr<GraphSolver> solver, Events& events) : solver_(std::move(solver)), events_(events) {}
    SolverReport solve(GraphProblem problem, const SolverOptions& options, std::vector<double>& values,
                       const RunControl& control) override {
      events_.push_back(Event::Solve);
      return solver_->solve(std::move(problem), options, values, control);
    }

   private:
    std::unique_ptr<GraphSolver> solver_;
    Events& events_;
  };

  std::unique_ptr<PoissonSolver> solver_;
  Events& events_;
};

class RecordingBackend final : public Backend {
 public:
  explicit RecordingBackend(Events& events) : events_(events) {}

  [[nodiscard]] std::string deviceName() const override { return "recording"; }
  [[nodiscard]] std::vector<std::string> deviceLines() const override { return {deviceName()}; }
  [[nodiscard]] std::unique_ptr<ConeTracer> makeTracer(const TraceScene& scene, const Cone& cone, const TracerNeeds&,
                                                       std::unique_ptr<EncodedScene>) override {
    return std::make_unique<RecordingTracer>(makeReferenceTracer(scene, cone), events_);
  }
  [[nodiscard]] std::unique_ptr<PoissonSolver> makeSolver(SolverChoice) const override {
    return std::make_unique<RecordingSolver>(events_);
  }

 private:
  Events& events_;
};

struct Outcome {
  Events events;
  uint32_t roundCount = 0;
  uint64_t seedCount = 0, faceCount = 0;
  size_t nodeCount = 0;  ///< Nodes of the hierarchy after the rounds.

  [[nodiscard]] auto count(Event event) const { return std::count(events.begin(), events.end(), event); }
  [[nodiscard]] auto release() const { return std::find(events.begin(), events.end(), Event::Release); }
};

Outcome run(Options options, bool keepsNodes = false) {
  Outcome outcome;
  options.solver = SolverChoice::Cpu;
  const Mesh mesh = makeTorus(4000).mesh;
  PreparedScene prepared(prepareMesh(mesh, Orientation::Keep));
  const TraceScene scene = prepared.view();
  const Cone cone = makeCone(options.cone);
  LazyBackend backend({BackendChoice::Cpu, "recording", std::make_unique<RecordingBackend>(outcome.events), {}});
  StageSeconds seconds;
  StageClock clock(seconds);
  std::vector<Warning> warnings;
  const FaceDomain domain = wholeMesh(prepared.prepared);
  const InputFaceSet all;
  const Computation computation{options, prepared.prepared, domain, all, scene, cone, backend, clock, warnings};
  const RoundsResult result = runRounds(computation, {prepared, nullptr, keepsNodes}, {});
  outcome.faceCount = mesh.faces.size();
  outcome.roundCount = result.roundCount;
  outcome.seedCount = result.seeds.size();
  outcome.nodeCount = prepared.bvh.nodes.size();
  return outcome;
}

}  // namespace

TEST_CASE("the tracer is released once, after the last ray and before all solutions, in one round and in two") {
  for (const bool isAdaptive : {false, true}) {
    CAPTURE(isAdaptive);
    Options options;
    options.seeds = SeedCount::ofShare(0.1);
    if (isAdaptive) options.sampler = SamplerChoice::Adaptive;
    const Outcome outcome = run(options);
    CHECK(outcome.roundCount == (isAdaptive ? 2u : 1u));
    CHECK(outcome.count(Event::Release) == 1);
    CHECK(std::find(outcome.release(), outcome.events.end(), Event::Trace) == outcome.events.end());
    CHECK(std::find(outcome.events.begin(), outcome.release(), Event::Solve) == outcome.release());
    CHECK(outcome.count(Event::Solve) == 1);  // Without held-out faces it is solved around them only.
    CHECK(outcome.count(Event::Trace) >= 3);  // Sampled seeds, held-out faces and extreme seeds.
    CHECK(outcome.seedCount == (outcome.faceCount + 5) / 10);
  }
}

TEST_CASE("the tracer is kept while further rounds may follow") {
  Options options;
  options.rounds.maxError = 0.004;
  options.seeds = SeedCount::ofShare(0.02);
  const Outcome outcome = run(options);
  CHECK(outcome.roundCount > 1);
  CHECK(outcome.count(Event::Release) == 1);
  CHECK(outcome.events.back() == Event::Release);
}

TEST_CASE("the nodes of the hierarchy are released with the tracer unless they are needed later") {
  CHECK(run({}).nodeCount == 0);
  CHECK(run({}, true).nodeCount > 0);
}
