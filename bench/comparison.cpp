#include "comparison.h"

#include <algorithm>
#include <functional>

#include "bare_embree.h"
#include "cgal_sdf.h"
#include "cli/choice_names.h"
#include "cli/option_values.h"
#include "core/stopwatch.h"
#include "file_run.h"
#include "io/mesh_reader.h"
#include "pipeline/compute_backend.h"
#include "pipeline/prepared_mesh.h"
#include "pipeline/seed_choice.h"
#include "run_process.h"
#include "seeds/samplers.h"
#include "temporary_folder.h"
#include "trace/embree/embree_tracer.h"
#include "trace/seed_order.h"

namespace asdfvk::bench {
namespace {

/// What is fast enough for whole computations.
std::vector<std::string> fastBackends() {
  return hasEmbree() ? std::vector<std::string>{"vulkan", "cpu"} : std::vector<std::string>{"vulkan"};
}

/// The backends by their names, and the kernels that are not the device's own choice.
std::map<std::string, std::unique_ptr<ComputeBackend>> contestants(const std::string& device) {
  std::map<std::string, std::unique_ptr<ComputeBackend>> all;
  all["reference"] = std::make_unique<ComputeBackend>(sessionOptionsOf("reference", device));
  for (const std::string& name : fastBackends())
    all[name] = std::make_unique<ComputeBackend>(sessionOptionsOf(name, device));
  const TraceKernel own = all["vulkan"]->traceChoice()->kernel;
  for (const auto& [name, kernel] : kTraceKernels) {
    if (!kernel || kernel == own) continue;
    SessionOptions options = sessionOptionsOf("vulkan", device);
    options.trace.kernel = kernel;
    all[std::string("vulkan ") + name] = std::make_unique<ComputeBackend>(options);
  }
  return all;
}

/// A mesh, what is traced in it, and all that trace it.
class Contest {
 public:
  Contest(std::string path, Mesh& mesh, const ComparisonRequest& request)
      : path_(std::move(path)),
        device_(request.device),
        mesh_(mesh),
        prepared_(prepareMesh(mesh, Orientation::Keep)),
        cone_(makeCone({})),
        bvh_(buildBvh(mesh, prepared_.geometry, prepared_.representatives)),
        bareEmbree_(makeBareEmbree(scene(), bvh_.slotFaces, cone_, BareMode::Fastest)),
        robustEmbree_(makeBareEmbree(scene(), bvh_.slotFaces, cone_, BareMode::Robust)),
        backends_(contestants(request.device)) {
    for (const auto& [name, backend] : backends_) tracers_[name] = backend->makeTracer(scene(), cone_);
    for (const std::string& name : fastBackends())
      sessions_[name] = std::make_unique<Session>(sessionOptionsOf(name, request.device));
  }

  std::string deviceOf(const std::string& backend) const { return backends_.at(backend)->deviceName(); }

  void measure(SeedComparison& comparison, uint32_t round, const RunControl& control) {
    const std::vector<uint32_t> seeds = chooseSeeds(comparison.seeds);
    comparison.rayCount = seeds.size() * cone_.directions.size();
    std::vector<std::pair<std::string, std::function<void()>>> traces;
    for (const auto& [name, tracer] : tracers_)
      traces.emplace_back(name, [&, &traceOne = *tracer] {
        std::vector<double> values(seeds.size());
        static_cast<void>(traceOne.trace(seeds, {values}, control));
      });
    if (bareEmbree_) {
      traces.emplace_back(kBareEmbree, [&] { static_cast<void>(bareEmbree_->trace(seeds)); });
      traces.emplace_back(kRobustEmbree, [&] { static_cast<void>(robustEmbree_->trace(seeds)); });
    }
    // Another one begins in each round: the first finds the caches full of other things.
    std::rotate(traces.begin(), traces.begin() + round % static_cast<uint32_t>(traces.size()), traces.end());
    for (const auto& [name, trace] : traces) {
      const Stopwatch watch;
      trace();
      comparison.trace[name].push_back(watch.seconds());
    }
    for (const auto& [name, session] : sessions_) {
      for (const Recipe recipe : {Recipe::Paper, Recipe::Balanced})
        comparison.whole[{name, std::string("compute, recipe ") + nameOf(kRecipes, recipe)}].push_back(
            computeSeconds(*session, comparison.seeds, recipe, control));
      comparison.whole[{name, "process, file to file"}].push_back(processSeconds(name, comparison.seeds));
    }
  }

 private:
  TraceScene scene() const { return {mesh_, prepared_.geometry, prepared_.representatives, bvh_}; }

  double computeSeconds(Session& session, const std::string& seeds, Recipe recipe, const RunControl& control) const {
    Options options;
    applyRecipe(recipe, options);
    options.seeds = parseSeedCount(seeds);
    options.estimatesError = false;  // Nobody else has one.
    const Stopwatch watch;
    static_cast<void>(session.compute(mesh_, options, control));
    return watch.seconds();
  }

  /// With the defaults, the estimate of the error included.
  double processSeconds(const std::string& backend, const std::string& seeds) const {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{
        path_, "--seeds", seeds, "--backend", backend, "-o", folder.path() / "result.ply", "--quiet"};
    if (backend == "vulkan" && !device_.empty()) arguments.insert(arguments.end(), {"--device", device_});
    const Stopwatch watch;
    static_cast<void>(outputOf(ASDFVK_PROGRAM, arguments));
    return watch.seconds();
  }

  /// In the hierarchy's order, which suits every tracer best; ours would bring them into it.
  std::vector<uint32_t> chooseSeeds(const std::string& count) const {
    const size_t candidateCount = prepared_.castableFaces.size();
    const std::vector<uint32_t> chosen = randomPermutationSeeds(
        prepared_.castableFaces, resolveSeedCount(parseSeedCount(count), candidateCount), Options{}.randomSeed);
    std::vector<uint32_t> seeds;
    for (const uint32_t i : SeedOrder(scene()).of(chosen)) seeds.push_back(chosen[i]);
    return seeds;
  }

  std::string path_, device_;
  Mesh& mesh_;
  PreparedMesh prepared_;
  Cone cone_;
  Bvh bvh_;
  std::unique_ptr<BareEmbree> bareEmbree_, robustEmbree_;
  std::map<std::string, std::unique_ptr<ComputeBackend>> backends_;
  std::map<std::string, std::unique_ptr<ConeTracer>> tracers_;
  std::map<std::string, std::unique_ptr<Session>> sessions_;
};

/// Which of the equal parts of all rounds a round is in.
size_t partOf(size_t round, size_t roundCount, size_t partCount) { return round * partCount / roundCount; }

bool isFirstOfPart(size_t round, size_t roundCount, size_t partCount) {
  const auto part = [&](size_t of) { return partOf(of, roundCount, partCount); };
  return partCount > 0 && (round == 0 || part(round) != part(round - 1));
}

/// What a round that is not counted leaves.
void forgetTimes(Comparison& comparison) {
  for (SeedComparison& seeds : comparison.seeds) {
    seeds.trace.clear();
    seeds.whole.clear();
  }
}

}  // namespace

Spread ratioOf(const Seconds& b, const Seconds& a) {
  std::vector<double> ratios;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) ratios.push_back(b[i] / a[i]);
  return spreadOf(std::move(ratios));
}

std::optional<Spread> cgalOver(const Comparison& comparison, const Seconds& ours) {
  if (comparison.cgal.empty()) return {};
  Seconds theirs;
  for (size_t round = 0; round < ours.size(); ++round)
    theirs.push_back(comparison.cgal[partOf(round, ours.size(), comparison.cgal.size())]);
  return ratioOf(theirs, ours);
}

Comparison compare(const std::string& path, const ComparisonRequest& request, const RunControl& control) {
  Mesh mesh = readMesh(path);
  Contest contest(path, mesh, request);
  Comparison comparison{path, mesh.inputFaceCount(), request.roundCount, {}, {}, {}};
  for (const std::string& name : fastBackends()) comparison.devices[name] = contest.deviceOf(name);
  for (const std::string& seeds : request.seeds) comparison.seeds.push_back({seeds, 0, {}, {}});
  for (uint32_t round = 0; round <= request.roundCount; ++round) {
    for (SeedComparison& seeds : comparison.seeds) contest.measure(seeds, round, control);
    if (round == 0)
      forgetTimes(comparison);
    else if (isFirstOfPart(round - 1, request.roundCount, std::min(request.cgalRunCount, request.roundCount)))
      if (const std::optional<double> seconds = cgalSeconds(mesh)) comparison.cgal.push_back(*seconds);
    control.checkpoint(0);
  }
  return comparison;
}

}  // namespace asdfvk::bench
