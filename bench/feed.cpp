// Measures how many rays per second the host can feed to a device, and the time of each step. The first table is for
// the tracer alone, with a device that takes no time. The second table is for the whole computation, with a kernel that
// writes lengths instead of tracing rays. The third table is for lanes of a batch, with a device that takes no time.
#include <fmt/format.h>
#include <volk.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <utility>

#include "asdf_vk/files.h"
#include "constant_backend.h"
#include "core/text.h"
#include "feed_lanes.h"
#include "generate/creatures.h"
#include "generate/generated_shape.h"
#include "idle_device.h"
#include "pipeline/compute.h"
#include "seeds/random_permutation.h"
#include "seeds/samplers.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Arguments {
  std::vector<std::string> meshes;
  std::string device;
  std::vector<uint32_t> percents = {100, 10};
  uint32_t roundCount = 5;
  std::string solver = "auto";
  uint64_t generatedFaceCount = 1'500'000;
  std::vector<uint32_t> laneCounts = {1, 2, 4};
  uint64_t laneFaceCount = 100'000;
  bool hasLanesOnly = false;
};

/// Waits and copies between host and device.
struct Traffic {
  double waitSeconds = 0;  ///< Time for which the host waits for the device.
  uint64_t waitCount = 0;
  uint64_t upByteCount = 0, downByteCount = 0;  ///< Copied bytes; 0 if the host maps the memory of the device.
};

/// Sums the traffic during its lifetime.
class TrafficCounter {
 public:
  TrafficCounter() {
    wait_ = vkWaitForFences, query_ = vkGetQueryPoolResults, create_ = vkCreateBuffer, destroy_ = vkDestroyBuffer,
    copy_ = vkCmdCopyBuffer;
    vkWaitForFences = [](VkDevice device, uint32_t count, const VkFence* fences, VkBool32 all, uint64_t timeout) {
      const Stopwatch watch;
      const VkResult result = wait_(device, count, fences, all, timeout);
      traffic_.waitSeconds += watch.seconds();
      ++traffic_.waitCount;
      return result;
    };
    // llvmpipe waits here for the commands whose fence is signalled.
    vkGetQueryPoolResults = [](VkDevice device, VkQueryPool pool, uint32_t first, uint32_t count, size_t size,
                               void* data, VkDeviceSize stride, VkQueryResultFlags flags) {
      const Stopwatch watch;
      const VkResult result = query_(device, pool, first, count, size, data, stride, flags);
      traffic_.waitSeconds += watch.seconds();
      return result;
    };
    vkCreateBuffer = [](VkDevice device, const VkBufferCreateInfo* info, const VkAllocationCallbacks* callbacks,
                        VkBuffer* buffer) {
      const VkResult result = create_(device, info, callbacks, buffer);
      constexpr VkBufferUsageFlags kCopies = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
      if (result == VK_SUCCESS && (info->usage & ~kCopies) == 0) ofHost_.insert(*buffer);  // No kernel uses this value.
      return result;
    };
    vkDestroyBuffer = [](VkDevice device, VkBuffer buffer, const VkAllocationCallbacks* callbacks) {
      ofHost_.erase(buffer);
      destroy_(device, buffer, callbacks);
    };
    vkCmdCopyBuffer = [](VkCommandBuffer commands, VkBuffer from, VkBuffer to, uint32_t count,
                         const VkBufferCopy* regions) {
      for (uint32_t i = 0; i < count; ++i)
        if (ofHost_.contains(from))
          traffic_.upByteCount += regions[i].size;
        else if (ofHost_.contains(to))
          traffic_.downByteCount += regions[i].size;
      copy_(commands, from, to, count, regions);
    };
  }
  ~TrafficCounter() {
    vkWaitForFences = wait_, vkGetQueryPoolResults = query_, vkCreateBuffer = create_, vkDestroyBuffer = destroy_,
    vkCmdCopyBuffer = copy_;
  }
  TrafficCounter(const TrafficCounter&) = delete;
  TrafficCounter& operator=(const TrafficCounter&) = delete;

  [[nodiscard]] static double waitSeconds() { return traffic_.waitSeconds; }
  [[nodiscard]] static Traffic take() { return std::exchange(traffic_, {}); }

 private:
  static inline PFN_vkWaitForFences wait_ = nullptr;
  static inline PFN_vkGetQueryPoolResults query_ = nullptr;
  static inline PFN_vkCreateBuffer create_ = nullptr;
  static inline PFN_vkDestroyBuffer destroy_ = nullptr;
  static inline PFN_vkCmdCopyBuffer copy_ = nullptr;
  static inline Traffic traffic_;
  static inline std::set<VkBuffer> ofHost_;
};

/// For each stage, the time for which the host waits for the device. A wait after the end of a stage is added to this
/// stage.
class StageWaits {
 public:
  void begin(Stage stage) {
    const double seconds = TrafficCounter::waitSeconds();
    seconds_[static_cast<size_t>(current_)] += seconds - seen_;
    seen_ = seconds;
    current_ = stage;
  }
  [[nodiscard]] double operator[](size_t stage) const { return seconds_[stage]; }

 private:
  std::array<double, kStageCount> seconds_{};
  double seen_ = 0;
  Stage current_ = Stage::Geometry;
};

std::string measureTracer(ConstantBackend& backend, const Mesh& source, const Arguments& arguments,
                          const RunControl& control) {
  const TraceableMesh mesh(source);
  const Cone cone = makeCone({});
  const std::vector<uint32_t>& faces = mesh.prepared.traceableFaces;
  std::string text = fmt::format(
      "\ntracer alone, {} rays per cone, commands are not run\n\n| seeds | hits | {:>14} | {:>14} | {:>14} |\n"
      "|---|---|---:|---:|---:|\n",
      cone.directions.size(), "seconds", "Mcones/s", "Grays/s");
  for (const uint32_t percent : arguments.percents) {
    std::vector<uint32_t> seeds = randomPermutationSeeds(faces, faces.size() * percent / 100, 1);
    std::sort(seeds.begin(), seeds.end());
    std::vector<double> values(seeds.size());
    for (const bool withHits : {false, true}) {
      std::vector<ConeHit> hits(withHits ? seeds.size() * cone.directions.size() : 0);
      const auto tracer = backend.makeTracer(mesh.scene(), cone, {.hits = withHits}, nullptr);
      backend.device().memory().clear();
      const IdleDevice idle;
      std::vector<double> seconds, coneRates, rayRates;
      for (uint32_t round = 0; round <= arguments.roundCount; ++round) {
        const Stopwatch watch;
        const TraceStatistics statistics = tracer->trace(seeds, {values, hits}, control);
        if (round == 0) continue;
        seconds.push_back(watch.seconds());
        coneRates.push_back(static_cast<double>(seeds.size()) / seconds.back() * 1e-6);
        rayRates.push_back(static_cast<double>(statistics.rayCount) / seconds.back() * 1e-9);
      }
      text += fmt::format("| {} % | {} | {:>14} | {:>14} | {:>14} |\n", percent, withHits ? "yes" : "no",
                          toText(dispersionOf(seconds), 4), toText(dispersionOf(coneRates), 1),
                          toText(dispersionOf(rayRates), 3));
      backend.device().memory().clear();
    }
  }
  return text;
}

std::string measurePipeline(SessionState& session, const Mesh& mesh, const Arguments& arguments,
                            const RunControl& control) {
  std::string text = "\nwhole computation, median seconds of the host by stage, without waiting for the device\n";
  for (const uint32_t percent : arguments.percents) {
    Options options = recipeOptions(Recipe::Balanced, percent);
    options.solver = choiceNamed(kSolverNames, arguments.solver);
    std::vector<std::vector<double>> stages(kStageCount);
    std::vector<double> totals, waits, hosts, rates;
    Traffic traffic;
    for (uint32_t round = 0; round <= arguments.roundCount; ++round) {
      (void)TrafficCounter::take();
      const Stopwatch watch;
      Result result;
      StageWaits stageWaits;
      StageClock clock(result.report.stageSeconds, [&](Stage stage) { stageWaits.begin(stage); });
      const auto scene = std::make_shared<PreparedScene>(prepareMesh(mesh, options.orientation, clock, control));
      computeOn({session, scene, nullptr, nullptr}, CheckedOptions(options), clock, control, result);
      stageWaits.begin(Stage::Geometry);
      if (round == 0) continue;
      totals.push_back(watch.seconds());
      traffic = TrafficCounter::take();
      waits.push_back(traffic.waitSeconds);
      rates.push_back(result.report.raysPerSecond * 1e-9);
      hosts.push_back(totals.back() - waits.back());
      for (size_t i = 0; i < kStageCount; ++i)
        stages[i].push_back(result.report.stageSeconds[static_cast<Stage>(i)] - stageWaits[i]);
    }
    text += fmt::format("\n{} %: total {}, waiting for the device {}, host {}, trace stage {} Grays/s\n ", percent,
                        toText(dispersionOf(totals), 3), toText(dispersionOf(waits), 3), toText(dispersionOf(hosts), 3),
                        toText(dispersionOf(rates), 3));
    for (size_t i = 0; i < kStageCount; ++i)
      if (const Dispersion seconds = dispersionOf(stages[i]); seconds.max > 0)
        text += fmt::format(" {} {:.3f}", nameOf(static_cast<Stage>(i)), seconds.median);
    text += fmt::format("\n  {} waits, {:.2f} MiB copied to the device, {:.2f} MiB from it\n", traffic.waitCount,
                        static_cast<double>(traffic.upByteCount) / (1 << 20),
                        static_cast<double>(traffic.downByteCount) / (1 << 20));
  }
  return text;
}

void measureOneSession(const Arguments& arguments, const RunControl& control) {
  const ConstantDevice device(arguments.device);
  SessionState session({.backend = BackendChoice::Reference}, SessionOpening::Now);
  auto backend = std::make_unique<ConstantBackend>(device);
  ConstantBackend& constant = *backend;
  session.backend =
      std::make_unique<LazyBackend>(NamedBackend{BackendChoice::Vulkan, "vulkan", std::move(backend), {}});
  const TrafficCounter counter;
  const auto measure = [&](const std::string& name, const Mesh& mesh) {
    writeOutput(fmt::format("{}: {} faces, {}, {}\n", name, groupDigits(mesh.faceCount()), constant.deviceName(),
                            toText(thisMachine())));
    writeOutput(measureTracer(constant, mesh, arguments, control));
    writeOutput(measurePipeline(session, mesh, arguments, control) + "\n");
  };
  for (const std::string& path : arguments.meshes) measure(path, readMesh(path));
  if (arguments.meshes.empty()) measure("generated animal", makeAnimal(arguments.generatedFaceCount).mesh);
}

void run(const Arguments& arguments, const RunControl& control) {
  if (!arguments.hasLanesOnly) measureOneSession(arguments, control);
  const Mesh mesh = makeAnimal(arguments.laneFaceCount).mesh;
  writeOutput(fmt::format("generated animal: {} faces\n", groupDigits(mesh.faceCount())));
  for (const uint32_t percent : arguments.percents)
    writeOutput(measureLanes(arguments.device, mesh, percent, arguments.laneCounts, arguments.roundCount, control));
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-feed", "Measures how fast the host feeds a device that traces nothing.");
  Arguments arguments;
  program.addOptionalMeshes(arguments.meshes, "a generated animal");
  program.add("--faces", arguments.generatedFaceCount, "Faces of the generated animal", {kMinFaceCount, kMaxFaceCount});
  program.add("--rounds", arguments.roundCount, "Rounds, after one for warm-up", {1, 1000});
  program.add("--seeds", arguments.percents, "Shares of the faces that cast rays, in percent", {1, 100});
  program.add("--lanes", arguments.laneCounts, "Numbers of lanes", {1, 64});
  program.add("--lane-faces", arguments.laneFaceCount, "Faces of the mesh of the lanes",
              {kMinFaceCount, kMaxFaceCount});
  program.add("--only-lanes", arguments.hasLanesOnly, "Measures only the lanes");
  program.add("--solver", arguments.solver, "Solver; with a solver of the device, the device also predicts");
  program.add("--device", arguments.device, "Vulkan device: index or part of its name");
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
