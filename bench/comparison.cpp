#include "comparison.h"

#include <algorithm>
#include <functional>
#include <memory>

#include "asdf_vk/choices.h"
#include "asdf_vk/files.h"
#include "baselines.h"
#include "core/stopwatch.h"
#include "pipeline/backend.h"
#include "pipeline/seed_choice.h"
#include "process/temporary_folder.h"
#include "seeds/random_permutation.h"
#include "seeds/samplers.h"
#include "support/computation.h"
#include "support/process.h"
#include "trace/cone_tracer.h"
#include "trace/seed_order.h"
#include "trace/vk/vulkan_trace_choice.h"

namespace asdfvk::bench {
namespace {

/// Backends whose whole computations are timed. The backend `reference` is left out, because it is too slow.
std::vector<std::string> fastBackends() { return {"vulkan", "cpu"}; }

/// All backends, and Vulkan with each kernel that is not the default of the device.
std::map<std::string, std::unique_ptr<Backend>> openBackends(const std::string& device) {
  std::map<std::string, std::unique_ptr<Backend>> backends;
  const auto open = [&](const std::string& name, const SessionOptions& options) {
    backends[name] = openBackend(options).backend;
  };
  open("reference", sessionOptionsOf("reference", device));
  for (const std::string& name : fastBackends()) open(name, sessionOptionsOf(name, device));
  const std::optional<TraceKernel> defaultKernel = backends["vulkan"]->traceVariant()->kernel;
  for (const auto& [name, kernel] : kKernels) {
    if (kernel == defaultKernel) continue;
    SessionOptions options = sessionOptionsOf("vulkan", device);
    options.variant.kernel = kernel;
    open(std::string("vulkan ") + name, options);
  }
  return backends;
}

class MeshComparison {
 public:
  MeshComparison(std::string path, const std::string& device)
      : path_(std::move(path)), device_(device), mesh_(readMesh(path_)), backends_(openBackends(device)) {
    for (const auto& [name, backend] : backends_)
      tracers_[name] = backend->makeTracer(mesh_.scene(), cone_, {}, nullptr);
    for (const EmbreeMode& mode : kEmbreeModes)
      if (auto baseline = makeEmbreeBaseline(mesh_.scene(), mesh_.bvh.primitiveFaces, cone_, mode))
        embree_[mode.name] = std::move(baseline);
    for (const std::string& name : fastBackends())
      sessions_[name] = std::make_unique<Session>(sessionOptionsOf(name, device));
  }

  [[nodiscard]] const Mesh& mesh() const { return mesh_.mesh; }
  [[nodiscard]] std::string deviceOf(const std::string& backend) const { return backends_.at(backend)->deviceName(); }

  void measure(SeedComparison& comparison, uint32_t round, const RunControl& control) {
    const std::vector<uint32_t> seeds = chooseSeeds(comparison.seeds);
    comparison.rayCount = seeds.size() * cone_.directions.size();
    std::vector<std::pair<std::string, std::function<void()>>> traces;
    for (const auto& [name, tracer] : tracers_)
      traces.emplace_back(name, [&, &chosen = *tracer] {
        std::vector<double> values(seeds.size());
        static_cast<void>(chosen.trace(seeds, {values}, control));
      });
    for (const auto& [name, baseline] : embree_)
      traces.emplace_back(name, [&, &chosen = *baseline] { static_cast<void>(chosen.trace(seeds)); });
    // The first tracer of a round starts with cold caches. Therefore each round starts with another tracer.
    std::rotate(traces.begin(), traces.begin() + round % static_cast<uint32_t>(traces.size()), traces.end());
    for (const auto& [name, trace] : traces) {
      const Stopwatch watch;
      trace();
      comparison.trace[name].push_back(watch.seconds());
    }
    for (const auto& [name, session] : sessions_) {
      for (const Recipe recipe : {Recipe::Paper, Recipe::Balanced})
        comparison.total[{name, std::string("compute, recipe ") + nameOf(kRecipes, recipe)}].push_back(
            computeSeconds(*session, comparison.seeds, recipe, control));
      comparison.total[{name, "process, file to file"}].push_back(processSeconds(name, comparison.seeds));
    }
  }

 private:
  double computeSeconds(Session& session, const std::string& seeds, Recipe recipe, const RunControl& control) {
    Options options;
    applyRecipe(recipe, options);
    options.seeds = parseSeedCount(seeds);
    options.estimatesError = false;  // No error estimate, because CGAL has none.
    const Stopwatch watch;
    static_cast<void>(session.compute(mesh_.mesh, options, control));
    return watch.seconds();
  }

  /// Time of the program with its default options, which include the error estimate.
  double processSeconds(const std::string& backend, const std::string& seeds) const {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{
        path_, "--seeds", seeds, "--backend", backend, "-o", folder.path() / "result.ply", "--quiet"};
    if (backend == "vulkan" && !device_.empty()) arguments.insert(arguments.end(), {"--device", device_});
    const Stopwatch watch;
    static_cast<void>(outputOf(ASDFVK_PROGRAM, arguments));
    return watch.seconds();
  }

  /// Random faces in the order of the hierarchy, which is the fastest order for every tracer. asdf-vk uses the same
  /// order.
  std::vector<uint32_t> chooseSeeds(const std::string& count) const {
    const std::vector<uint32_t>& candidates = mesh_.prepared.traceableFaces;
    const std::vector<uint32_t> chosen = randomPermutationSeeds(
        candidates, resolveSeedCount({.seeds = parseSeedCount(count)}, candidates.size()), Options{}.randomSeed);
    std::vector<uint32_t> seeds;
    for (const uint32_t i : SeedOrder(mesh_.scene()).of(chosen)) seeds.push_back(chosen[i]);
    return seeds;
  }

  std::string path_, device_;
  TraceableMesh mesh_;
  Cone cone_ = makeCone({});
  std::map<std::string, std::unique_ptr<EmbreeBaseline>> embree_;
  std::map<std::string, std::unique_ptr<Backend>> backends_;
  std::map<std::string, std::unique_ptr<ConeTracer>> tracers_;
  std::map<std::string, std::unique_ptr<Session>> sessions_;
};

/// The rounds are divided into equal parts. Returns the index of the part that contains the round.
size_t partOf(size_t round, size_t roundCount, size_t partCount) { return round * partCount / roundCount; }

bool isFirstOfPart(size_t round, size_t roundCount, size_t partCount) {
  return partCount > 0 &&
         (round == 0 || partOf(round, roundCount, partCount) != partOf(round - 1, roundCount, partCount));
}

}  // namespace

std::optional<Dispersion> SeedComparison::speedOverEmbree(const std::string& tracer) const {
  const auto embree = trace.find(kEmbreeFast.name);
  if (embree == trace.end()) return {};
  return ratioOf(embree->second, trace.at(tracer));
}

std::optional<Dispersion> Comparison::cgalOver(const Seconds& seconds) const {
  if (cgal.empty()) return {};
  Seconds cgalOfRound;
  for (size_t round = 0; round < seconds.size(); ++round)
    cgalOfRound.push_back(cgal[partOf(round, seconds.size(), cgal.size())]);
  return ratioOf(cgalOfRound, seconds);
}

Comparison compare(const std::string& path, const ComparisonRequest& request, const RunControl& control) {
  MeshComparison tasks(path, request.device);
  Comparison comparison{path, tasks.mesh().inputFaceCount(), request.roundCount};
  for (const std::string& name : fastBackends()) comparison.devices[name] = tasks.deviceOf(name);
  for (const std::string& seeds : request.seeds) comparison.seeds.push_back({seeds});
  const uint32_t cgalRunCount = std::min(request.cgalRunCount, request.roundCount);
  std::vector<SeedComparison> warmUp = comparison.seeds;
  for (SeedComparison& seeds : warmUp) tasks.measure(seeds, 0, control);
  for (uint32_t round = 0; round < request.roundCount; ++round) {
    for (SeedComparison& seeds : comparison.seeds) tasks.measure(seeds, round + 1, control);
    if (isFirstOfPart(round, request.roundCount, cgalRunCount))
      if (const std::optional<double> seconds = cgalSeconds(tasks.mesh())) comparison.cgal.push_back(*seconds);
    control.checkpoint(0);
  }
  return comparison;
}

}  // namespace asdfvk::bench
