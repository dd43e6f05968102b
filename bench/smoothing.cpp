// What bilateral smoothing gives: the average error of the function traced at every face with few rays, against one
// with many, before and after; and its time.
#include <fmt/format.h>

#include <array>

#include "bench_program.h"
#include "cli/report_text.h"
#include "cli/terminal.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "file_run.h"
#include "io/mesh_reader.h"
#include "pipeline/compute_backend.h"
#include "pipeline/prepared_mesh.h"
#include "share_errors.h"
#include "smooth/bilateral.h"
#include "spread.h"

namespace {

using namespace asdfvk;

constexpr std::array<BilateralOptions, 7> kVariants{{{1, 1}, {1, 2}, {1, 3}, {2, 1}, {2, 2}, {3, 1}, {4, 1}}};

struct Arguments {
  std::vector<std::string> meshes;
  std::string device;
  uint32_t rayCount = 30, truthRayCount = 1000, runCount = 5;
};

std::vector<double> traceAllFaces(ComputeBackend& backend, const TraceScene& scene, const ConeOptions& options,
                                  const std::vector<uint32_t>& faces, const RunControl& control) {
  const Cone cone = makeCone(options);
  std::vector<double> values(faces.size()), field(scene.mesh.faceCount(), kNoValue);
  backend.makeTracer(scene, cone)->trace(faces, {values}, control);
  for (size_t i = 0; i < faces.size(); ++i) field[faces[i]] = values[i];
  return field;
}

template <typename Smooth>
bench::Spread milliseconds(uint32_t runCount, const Smooth& smooth) {
  std::vector<double> samples;
  for (uint32_t run = 0; run <= runCount; ++run) {
    const Stopwatch watch;
    static_cast<void>(smooth());
    if (run > 0) samples.push_back(1e3 * watch.seconds());
  }
  return bench::spreadOf(samples);
}

void compare(ComputeBackend& backend, const std::string& path, const Arguments& arguments, const RunControl& control) {
  Mesh mesh = readMesh(path);
  const PreparedMesh prepared = prepareMesh(mesh, Orientation::Keep);
  const Bvh bvh = buildBvh(mesh, prepared.geometry, prepared.representatives);
  const TraceScene scene{mesh, prepared.geometry, prepared.representatives, bvh};
  const auto trace = [&](uint32_t rayCount, ConeRotation rotation) {
    ConeOptions options;
    options.rayCount = rayCount;
    options.rotation = rotation;
    return traceAllFaces(backend, scene, options, prepared.castableFaces, control);
  };
  const std::vector<double> truth = trace(arguments.truthRayCount, ConeRotation::Hashed);
  const std::vector<double> hashed = trace(arguments.rayCount, ConeRotation::Hashed);
  const std::vector<double> fixed = trace(arguments.rayCount, ConeRotation::Fixed);

  const BilateralOptions chosen = bilateralOptionsFor(mesh.faceCount());
  std::string text = fmt::format(
      "{}: {} faces, {} rays against {}, average error over the range of the latter; {}\n"
      "chosen for so many faces: window {}, passes {}\n\n"
      "| window | passes | hashed cones | fixed cones | ms |\n"
      "|-------:|-------:|-------------:|------------:|---:|\n"
      "|      - |      0 | {:.4f} | {:.4f} | |\n",
      path, groupDigits(mesh.faceCount()), arguments.rayCount, arguments.truthRayCount, backend.deviceName(),
      chosen.window, chosen.passes, bench::errorsOverRange(truth, hashed).average,
      bench::errorsOverRange(truth, fixed).average);
  for (const BilateralOptions& options : kVariants) {
    const auto smooth = [&](const std::vector<double>& values) {
      return smoothBilaterally(prepared.graph, values, options);
    };
    const auto error = [&](const std::vector<double>& values) { return bench::errorsOverRange(truth, values).average; };
    text +=
        fmt::format("| {:>6} | {:>6} | {:.4f} | {:.4f} | {} |\n", options.window, options.passes, error(smooth(hashed)),
                    error(smooth(fixed)), toText(milliseconds(arguments.runCount, [&] { return smooth(hashed); }), 1));
  }
  writeStandardOutput(text + "\n");
}

}  // namespace

int main(int argc, char** argv) {
  bench::BenchProgram program("asdfvk-bench-smoothing",
                              "Error of the full function before and after bilateral smoothing, and its time.");
  Arguments arguments;
  program.addMeshes(arguments.meshes);
  program.add("--rays", arguments.rayCount, "Rays per face");
  program.add("--truth-rays", arguments.truthRayCount, "Rays per face of what errors are against");
  program.add("--runs", arguments.runCount, "Timed runs, after one that warms up", {1, 1000});
  program.add("--device", arguments.device, "As asdf-vk takes it");
  return program.run(argc, argv, [&](const RunControl& control) {
    ComputeBackend backend(bench::sessionOptionsOf("vulkan", arguments.device));
    for (const std::string& mesh : arguments.meshes) compare(backend, mesh, arguments, control);
  });
}
