// What does bilateral smoothing gain and cost? The average error of the function traced at every face with few rays,
// against the one with many rays, before and after smoothing; and the time of smoothing.
#include <fmt/format.h>

#include <array>

#include "asdf_vk/files.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "pipeline/backend.h"
#include "smooth/bilateral.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

constexpr std::array<SmoothingOptions::Window, 7> kVariants{{{1, 1}, {1, 2}, {1, 3}, {2, 1}, {2, 2}, {3, 1}, {4, 1}}};

struct Arguments {
  std::vector<std::string> meshes;
  std::string device;
  uint32_t rayCount = 30, truthRayCount = 1000, runCount = 5;
};

/// The function with `rayCount` rays at every face.
std::vector<double> traceAllFaces(Backend& backend, const TraceableMesh& mesh, uint32_t rayCount, ConeRotation rotation,
                                  const RunControl& control) {
  const Cone cone = makeCone({.rayCount = rayCount, .rotation = rotation});
  const std::vector<uint32_t>& faces = mesh.prepared.traceableFaces;
  std::vector<double> values(faces.size()), field(mesh.mesh.faceCount(), kNoValue);
  backend.makeTracer(mesh.scene(), cone, {})->trace(faces, {values}, control);
  for (size_t i = 0; i < faces.size(); ++i) field[faces[i]] = values[i];
  return field;
}

template <typename Task>
Dispersion milliseconds(uint32_t runCount, const Task& task) {
  std::vector<double> samples;
  for (uint32_t run = 0; run <= runCount; ++run) {
    const Stopwatch watch;
    static_cast<void>(task());
    if (run > 0) samples.push_back(1e3 * watch.seconds());
  }
  return dispersionOf(samples);
}

void measure(Backend& backend, const std::string& path, const Arguments& arguments, const RunControl& control) {
  const TraceableMesh mesh(readMesh(path));
  const std::vector<double> truth =
      traceAllFaces(backend, mesh, arguments.truthRayCount, ConeRotation::Hashed, control);
  const std::vector<double> hashed = traceAllFaces(backend, mesh, arguments.rayCount, ConeRotation::Hashed, control);
  const std::vector<double> fixed = traceAllFaces(backend, mesh, arguments.rayCount, ConeRotation::Fixed, control);
  const auto error = [&](const std::vector<double>& values) { return errorsOverRange(truth, values).average; };

  const SmoothingOptions::Window automatic = smoothingWindowFor(mesh.mesh.faceCount());
  std::string text = fmt::format(
      "{}: {} faces; {}\naverage error of {} rays against {} rays, over the range of the latter; automatic choice: "
      "rings {}, passes {}\n\n"
      "|  rings | passes | hashed cones | fixed cones | ms |\n"
      "|-------:|-------:|-------------:|------------:|---:|\n"
      "|      - |      0 |       {:.4f} |      {:.4f} |    |\n",
      path, groupDigits(mesh.mesh.faceCount()), backend.deviceName(), arguments.rayCount, arguments.truthRayCount,
      automatic.rings, automatic.passes, error(hashed), error(fixed));
  for (const SmoothingOptions::Window& window : kVariants) {
    const auto smooth = [&](const std::vector<double>& values) {
      return smoothBilaterally(mesh.prepared.graph, values, window);
    };
    text += fmt::format("| {:>6} | {:>6} |       {:.4f} |      {:.4f} | {} |\n", window.rings, window.passes,
                        error(smooth(hashed)), error(smooth(fixed)),
                        toText(milliseconds(arguments.runCount, [&] { return smooth(hashed); }), 1));
  }
  writeOutput(text + "\n");
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-smoothing",
                  "Error of the full function before and after bilateral smoothing, and its time.");
  Arguments arguments;
  program.addMeshes(arguments.meshes);
  program.add("--rays", arguments.rayCount, "Rays per face");
  program.add("--truth-rays", arguments.truthRayCount, "Rays per face of the truth");
  program.add("--runs", arguments.runCount, "Timed runs, after one for warm-up", {1, 1000});
  program.add("--device", arguments.device, "Vulkan device: index or part of its name");
  return program.run(argc, argv, [&](const RunControl& control) {
    const NamedBackend named = openBackend(sessionOptionsOf("vulkan", arguments.device));
    for (const std::string& mesh : arguments.meshes) measure(*named.backend, mesh, arguments, control);
  });
}
