// How fast the variants of the cone kernels are on a device: rays per second of each, turn by turn in one run.
#include <fmt/format.h>

#include <memory>

#include "bench_program.h"
#include "bvh/bvh.h"
#include "cli/terminal.h"
#include "core/stopwatch.h"
#include "machine.h"
#include "mesh/mesh_reader.h"
#include "pipeline/prepared_mesh.h"
#include "seeds/random_permutation.h"
#include "spread.h"
#include "trace/vulkan_tracer.h"
#include "vk/open_device.h"

namespace {

using namespace asdfvk;

struct Arguments {
  std::vector<std::string> meshes;
  std::string device;
  std::vector<std::string> shares = {"all", "10%"};
  std::vector<std::string> only;
  uint32_t roundCount = 5;
  uint32_t rayCount = 30;
};

struct Variant {
  std::string name;
  VulkanTraceChoice choice;
  std::optional<VulkanWorkgroupShape> shape = {};
};

std::vector<Variant> variants(const DeviceFacts& facts) {
  std::vector<Variant> all;
  for (const TraceKernel kernel : {TraceKernel::Ray, TraceKernel::Seed})
    for (const BvhLayout bvh : {BvhLayout::Binary, BvhLayout::Wide})
      for (const BvhFetch fetch : {BvhFetch::Texel, BvhFetch::Storage})
        all.push_back(
            {fmt::format("{} {} {}", kernel == TraceKernel::Ray ? "ray" : "seed",
                         bvh == BvhLayout::Binary ? "binary" : "wide", fetch == BvhFetch::Texel ? "texel" : "storage"),
             {kernel, bvh, fetch}});
  const VulkanTraceChoice seed{TraceKernel::Seed, BvhLayout::Wide, BvhFetch::Texel};
  for (const uint32_t lanes : {2u, 4u, 8u}) {
    VulkanWorkgroupShape shape = workgroupShapeFor(facts, 30, TraceKernel::Seed);
    shape.lanesPerCone = lanes;
    shape.conesPerWorkgroup /= lanes;
    all.push_back({fmt::format("seed wide texel x{}", lanes), seed, shape});
  }
  for (const uint32_t lanes : {8u, 32u, 256u}) {
    VulkanWorkgroupShape shape = workgroupShapeFor(facts, 30, TraceKernel::Seed);
    shape.conesPerWorkgroup = lanes;
    all.push_back({fmt::format("seed wide texel /{}", lanes), seed, shape});
  }
  return all;
}

void measure(const std::string& path, const Arguments& arguments, const Device& device, const RunControl& control) {
  Mesh mesh = readMesh(path);
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  const Bvh bvh = buildBvh(mesh, prepared.geometry, prepared.representatives);
  const TraceScene scene{mesh, prepared.geometry, prepared.representatives, bvh};
  const Cone cone = makeCone({.rayCount = arguments.rayCount});
  std::vector<Variant> rows;
  for (Variant& variant : variants(device.facts()))
    if (arguments.only.empty() ||
        std::find(arguments.only.begin(), arguments.only.end(), variant.name) != arguments.only.end() || rows.empty())
      rows.push_back(std::move(variant));
  std::vector<std::unique_ptr<VulkanConeKernel>> kernels;
  std::vector<std::unique_ptr<ConeTracer>> tracers;
  for (const Variant& row : rows) {
    const ConeKernelRequest request{arguments.rayCount, false, row.choice};
    kernels.push_back(row.shape ? std::make_unique<VulkanConeKernel>(device, request, *row.shape)
                                : std::make_unique<VulkanConeKernel>(device, request));
    tracers.push_back(makeVulkanTracer(*kernels.back(), scene, cone));
  }
  for (const std::string& share : arguments.shares) {
    const std::vector<uint32_t>& castable = prepared.castableFaces;
    const std::vector<uint32_t> seeds =
        share == "all" ? castable : randomPermutationSeeds(castable, castable.size() / 10, 1);
    std::vector<double> values(seeds.size());
    std::vector<std::vector<double>> rates(rows.size()), ratios(rows.size());
    std::vector<TraceStatistics> statistics(rows.size());
    for (uint32_t round = 0; round <= arguments.roundCount; ++round) {
      double first = 0;
      for (size_t i = 0; i < rows.size(); ++i) {
        const Stopwatch watch;
        statistics[i] = tracers[i]->trace(seeds, {values}, control);
        const double rate = static_cast<double>(statistics[i].rayCount) / watch.seconds() * 1e-6;
        if (i == 0) first = rate;
        if (round == 0) continue;
        rates[i].push_back(rate);
        ratios[i].push_back(rate / first);
      }
    }
    writeStandardOutput(fmt::format("{}, {}: {} cones\n", path, share, seeds.size()));
    for (size_t i = 0; i < rows.size(); ++i)
      writeStandardOutput(fmt::format("| {:24} | {:>14} | {:>12} | {} |\n", rows[i].name,
                                      bench::toText(bench::spreadOf(rates[i]), 2),
                                      bench::toText(bench::spreadOf(ratios[i]), 2), statistics[i].redoneConeCount));
  }
}

void run(const Arguments& arguments, const RunControl& control) {
  const Instance instance;
  const OpenedDevice opened = openDevice(instance, {.selector = arguments.device});
  writeStandardOutput(fmt::format("{}, {}\n", opened.device->facts().name, bench::toText(bench::thisMachine())));
  for (const std::string& mesh : arguments.meshes) measure(mesh, arguments, *opened.device, control);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times the variants of the cone kernels, turn by turn in one run.", "asdfvk-bench-kernels");
  Arguments arguments;
  app.add_option("meshes", arguments.meshes, "Meshes")->option_text("MESH...")->required();
  app.add_option("--rounds", arguments.roundCount, "Counted rounds, after one that warms up")->capture_default_str();
  app.add_option("--seeds", arguments.shares, "all or 10%")->delimiter(',')->capture_default_str();
  app.add_option("--only", arguments.only, "Names of variants")->delimiter(',');
  app.add_option("--rays", arguments.rayCount, "Rays per cone")->capture_default_str();
  app.add_option("--device", arguments.device, "As asdf-vk takes it");
  return bench::runBenchProgram(app, argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
