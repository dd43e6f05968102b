// How fast is each variant of the cone kernels on a device? All variants run in turns.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "asdf_vk/files.h"
#include "seeds/samplers.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"
#include "trace/vulkan/vulkan_tracer.h"
#include "vk/device.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Arguments {
  std::vector<std::string> meshes;
  std::string device;
  std::vector<uint32_t> percents = {100, 10};
  std::vector<std::string> only;
  uint32_t roundCount = 5;
  uint32_t rayCount = 30;
};

// The oldest variant; the rates of the others are given as ratios to its rate.
constexpr VulkanTraceChoice kBaseline{TraceKernel::Ray, BvhLayout::Binary, BvhFetch::Texel};

struct Row {
  std::string name;
  std::unique_ptr<VulkanConeKernel> kernel;
  std::unique_ptr<ConeTracer> tracer;
  std::vector<double> rates = {}, ratios = {};
  TraceStatistics statistics = {};
};

/// All variants, the baseline first.
std::vector<VulkanTraceChoice> allVariants() {
  std::vector<VulkanTraceChoice> all = {kBaseline};
  for (const TraceKernel kernel : {TraceKernel::Packet, TraceKernel::Ray, TraceKernel::Seed})
    for (const BvhLayout bvh : {BvhLayout::Binary, BvhLayout::Wide})
      for (const BvhFetch fetch : {BvhFetch::Texel, BvhFetch::Storage})
        if (const VulkanTraceChoice choice{kernel, bvh, fetch}; choice != kBaseline) all.push_back(choice);
  return all;
}

/// "seed wide texel"
std::string nameOf(const VulkanTraceChoice& choice) {
  const TraceVariant variant = variantOf(choice);
  return fmt::format("{} {} {}", variant.kernel, variant.bvh, variant.fetch);
}

std::vector<Row> makeRows(const Arguments& arguments, const Device& device, const TraceScene& scene, const Cone& cone) {
  std::vector<Row> rows;
  const auto add = [&](const std::string& name, const VulkanTraceChoice& choice,
                       const std::optional<VulkanWorkgroupShape>& shape) {
    const bool isSelected = arguments.only.empty() || rows.empty() ||
                            std::find(arguments.only.begin(), arguments.only.end(), name) != arguments.only.end();
    if (!isSelected) return;
    const ConeKernelRequest request{arguments.rayCount, false, choice};
    auto kernel = shape ? std::make_unique<VulkanConeKernel>(device, request, *shape)
                        : std::make_unique<VulkanConeKernel>(device, request);
    auto tracer = makeVulkanTracer(*kernel, scene, cone);
    rows.push_back({name, std::move(kernel), std::move(tracer)});
  };
  for (const VulkanTraceChoice& choice : allVariants()) add(nameOf(choice), choice, {});
  const VulkanTraceChoice seed{TraceKernel::Seed, BvhLayout::Wide, BvhFetch::Texel};
  const VulkanWorkgroupShape shape = workgroupShapeFor(device.facts(), arguments.rayCount, TraceKernel::Seed);
  const uint32_t laneCount = shape.lanesPerCone * shape.conesPerWorkgroup;
  for (const uint32_t rays : {2u, 4u, 8u})
    add(fmt::format("seed wide texel, {} rays", rays), seed, {{rays, laneCount / rays, shape.iterationLimit}});
  for (const uint32_t lanes : {8u, 32u, 256u})
    add(fmt::format("seed wide texel, {} lanes", lanes), seed, {{1, lanes, shape.iterationLimit}});
  return rows;
}

void timeRows(std::vector<Row>& rows, const std::vector<uint32_t>& seeds, uint32_t roundCount, Clock clock,
              const RunControl& control) {
  std::vector<double> values(seeds.size());
  for (Row& row : rows) row.rates.clear(), row.ratios.clear();
  for (uint32_t round = 0; round <= roundCount; ++round) {
    double baseline = 0;
    for (Row& row : rows) {
      const Timer timer(clock);
      row.statistics = row.tracer->trace(seeds, {values}, control);
      const double rate = static_cast<double>(row.statistics.rayCount) / timer.seconds() * 1e-6;
      if (&row == &rows.front()) baseline = rate;
      if (round == 0) continue;  // Warm-up.
      row.rates.push_back(rate);
      row.ratios.push_back(rate / baseline);
    }
  }
}

void measure(const std::string& path, const Arguments& arguments, const Device& device, const RunControl& control) {
  const TraceableMesh mesh(readMesh(path));
  const std::vector<uint32_t>& faces = mesh.prepared.traceableFaces;
  const Cone cone = makeCone({.rayCount = arguments.rayCount});
  const Clock clock = device.facts().kind == DeviceKind::Cpu ? Clock::ProcessCpu : Clock::Wall;
  std::vector<Row> rows = makeRows(arguments, device, mesh.scene(), cone);
  for (const uint32_t percent : arguments.percents) {
    const std::vector<uint32_t> seeds = randomPermutationSeeds(faces, faces.size() * percent / 100, 1);
    timeRows(rows, seeds, arguments.roundCount, clock, control);
    std::string text =
        fmt::format("\n{}, {} % of the faces: {} cones of {} rays\n", path, percent, seeds.size(), arguments.rayCount);
    text += fmt::format("\n| {:24} | {:>14} | {:>10} | redone |\n|:---|---:|---:|---:|\n", "kernel",
                        clock == Clock::ProcessCpu ? "Mrays/s a core" : "Mrays/s", "ratio");
    for (const Row& row : rows)
      text += fmt::format("| {:24} | {:>14} | {:>10} | {:>6} |\n", row.name, toText(dispersionOf(row.rates), 2),
                          toText(dispersionOf(row.ratios), 2), row.statistics.redoneConeCount);
    writeOutput(text);
  }
}

void run(const Arguments& arguments, const RunControl& control) {
  const Instance instance;
  const OpenedDevice opened = openDevice(instance, {.selector = arguments.device});
  writeOutput(fmt::format("{}, {}\n", opened.device->facts().name, toText(thisMachine())));
  for (const std::string& mesh : arguments.meshes) measure(mesh, arguments, *opened.device, control);
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-kernels", "Times the variants of the cone kernels in turns.");
  Arguments arguments;
  program.addMeshes(arguments.meshes);
  program.add("--rounds", arguments.roundCount, "Rounds, after one for warm-up", {1, 1000});
  program.add("--seeds", arguments.percents, "Shares of the faces that cast rays, in percent", {1, 100});
  program.add("--only", arguments.only, "Rows by name, besides the first one", '/');
  program.add("--rays", arguments.rayCount, "Rays per cone", {1, 1024});
  program.add("--device", arguments.device, "Vulkan device: index or part of its name");
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
