#include "feed_lanes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <ctime>
#include <fstream>
#include <future>
#include <memory>

#include "constant_backend.h"
#include "core/parallel.h"
#include "describe/report_keys.h"
#include "idle_device.h"
#include "pipeline/compute.h"
#include "support/computation.h"
#include "support/measurement.h"

namespace asdfvk::bench {
namespace {

double cpuSecondsOfThread() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// CPU seconds of one thread by stage. The time after the end of a stage is added to this stage.
class StageCpu {
 public:
  void begin(Stage stage) {
    const double seconds = cpuSecondsOfThread();
    seconds_[static_cast<size_t>(current_)] += seconds - began_;
    began_ = seconds;
    current_ = stage;
  }
  [[nodiscard]] const std::array<double, kStageCount>& seconds() const { return seconds_; }

 private:
  std::array<double, kStageCount> seconds_{};
  double began_ = cpuSecondsOfThread();
  Stage current_ = Stage::Geometry;
};

/// Seconds in which this thread ran or was ready to run, from the scheduler of Linux; 0 if it does not count them.
/// Other load on the machine does not change the rest of the elapsed time, in which the thread waits.
double readySecondsOfThread() {
  std::ifstream file("/proc/thread-self/schedstat");
  double running = 0, queued = 0;
  file >> running >> queued;
  return 1e-9 * (running + queued);
}

/// A session on a shared device.
class Lane {
 public:
  explicit Lane(const ConstantDevice& device) : session_({.backend = BackendChoice::Reference}, SessionOpening::Now) {
    session_.backend = std::make_unique<LazyBackend>(
        NamedBackend{BackendChoice::Vulkan, "vulkan", std::make_unique<ConstantBackend>(device), {}});
  }

  void compute(const Mesh& mesh, const CheckedOptions& options, const RunControl& control) {
    Result result;
    StageClock clock(result.report.stageSeconds, [this](Stage stage) { cpu.begin(stage); });
    const auto scene = std::make_shared<PreparedScene>(prepareMesh(mesh, options->orientation, clock, control));
    computeOn({session_, scene, nullptr, nullptr}, options, clock, control, result);
    cpu.begin(Stage::Geometry);
  }

  StageCpu cpu;

 private:
  SessionState session_;
};

/// Calls body(lane) for all lanes at the same time, each in a thread whose loops use `threadCount` threads.
template <typename Body>
void inLanes(const std::vector<std::unique_ptr<Lane>>& lanes, uint32_t threadCount, const Body& body) {
  std::vector<std::future<void>> ends;
  for (const std::unique_ptr<Lane>& lane : lanes)
    ends.push_back(
        std::async(std::launch::async, [&, own = lane.get()] { callWithThreads(threadCount, [&] { body(*own); }); }));
  for (std::future<void>& end : ends) end.get();
}

}  // namespace

std::string measureLanes(const std::string& device, const Mesh& mesh, double percent,
                         const std::vector<uint32_t>& laneCounts, uint32_t roundCount, const RunControl& control) {
  const auto coreCount = static_cast<uint32_t>(threadLimit());
  const ConstantDevice opened(device, *std::ranges::max_element(laneCounts));
  if (opened.opened.device->facts().isCpu()) return "\nlanes: not measured on a CPU device\n";
  const IdleDevice idle;
  const CheckedOptions options(recipeOptions(Recipe::Balanced, percent));
  std::string text = fmt::format(
      "\nlanes, {} %, commands are not run, {} threads in all lanes\n\n"
      "| lanes | meshes/s | CPU seconds per mesh | wall / (CPU / threads) | share of the wall in which the thread of a "
      "lane "
      "waits |\n|---:|---:|---:|---:|---:|\n",
      percent, coreCount);
  std::string stages;
  for (const uint32_t laneCount : laneCounts) {
    std::vector<std::unique_ptr<Lane>> lanes;
    for (uint32_t i = 0; i < laneCount; ++i) lanes.push_back(std::make_unique<Lane>(opened));
    const uint32_t threadCount = std::max(1U, coreCount / laneCount);
    inLanes(lanes, threadCount, [&](Lane& lane) { lane.compute(mesh, options, control); });
    std::atomic<double> waitingSeconds = 0;
    const Timer wall(Clock::Wall), cpu(Clock::ProcessCpu);
    inLanes(lanes, threadCount, [&](Lane& lane) {
      lane.cpu = {};
      const Stopwatch watch;
      const double ready = readySecondsOfThread();
      for (uint32_t round = 0; round < roundCount; ++round) lane.compute(mesh, options, control);
      waitingSeconds += watch.seconds() - (readySecondsOfThread() - ready);
    });
    const double wallSeconds = wall.seconds(), cpuSeconds = cpu.seconds();
    const double meshCount = laneCount * roundCount;
    text += fmt::format("| {} | {:.1f} | {:.4f} | {:.2f} | {:.1f} % |\n", laneCount, meshCount / wallSeconds,
                        cpuSeconds / meshCount, wallSeconds / (cpuSeconds / coreCount),
                        100 * waitingSeconds / (laneCount * wallSeconds));
    stages += fmt::format("\n{} lanes, CPU seconds per mesh in the thread of the lane:", laneCount);
    for (size_t i = 0; i < kStageCount; ++i) {
      double sum = 0;
      for (const std::unique_ptr<Lane>& lane : lanes) sum += lane->cpu.seconds()[i];
      if (sum > 0) stages += fmt::format(" {} {:.4f}", nameOf(static_cast<Stage>(i)), sum / meshCount);
    }
  }
  return text + stages + "\n";
}

}  // namespace asdfvk::bench
