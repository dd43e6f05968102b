// How long does the wall thickness of all faces take, compared with their shape diameter, and is it right? Compares the
// backends with brute-force nearest points in double on sampled faces, and prints how far meshes of shapes with a known
// thickness are from it, and from brute force.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "asdf_vk/files.h"
#include "cone/thickness.h"
#include "generate/shapes.h"
#include "support/brute_force_thickness.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Arguments {
  std::vector<std::string> meshes, backends{"vulkan", "cpu", "reference"};
  uint32_t runs = 5, faces = 200;
  bool shapes = false;
};

Options optionsOf(Measure measure) {
  Options options;
  options.seeds = SeedCount::all();
  options.measure = measure;
  return options;
}

/// Seconds from the mesh in memory to the result, of one call.
double secondsOf(Session& session, const Mesh& mesh, Measure measure, const RunControl& control) {
  const Timer timer(Clock::ProcessCpu);
  (void)session.compute(mesh, optionsOf(measure), {control.stop, {}});
  return timer.seconds();
}

/// CPU seconds of the stages of all calls, in alternation after a warm-up.
void printTimes(const std::string& name, Session& session, const Mesh& mesh, uint32_t runs, const RunControl& control) {
  std::vector<double> diameter, thickness;
  for (uint32_t run = 0; run <= runs; ++run) {
    const double plain = secondsOf(session, mesh, Measure::ShapeDiameter, control);
    const double measured = secondsOf(session, mesh, Measure::Thickness, control);
    if (run == 0) continue;
    diameter.push_back(plain);
    thickness.push_back(measured);
  }
  writeOutput(fmt::format("| {} | {} | {} | {} | {} |\n", name, session.backend(), toText(dispersionOf(diameter), 3),
                          toText(dispersionOf(thickness), 3), toText(ratioOf(thickness, diameter), 2)));
}

/// Thickness of the triangles of a mesh.
std::vector<double> thicknessOf(Session& session, const Mesh& mesh, const RunControl& control) {
  return *session.compute(mesh, optionsOf(Measure::Thickness), {control.stop, {}}).field("thickness")->reals();
}

struct Differences {
  size_t sampled = 0, count = 0, within = 0;  // Faces; those with an opposing wall; those within 1e-4 of the diagonal.
  double worst = 0, worstRelative = 0;
  uint32_t worstFace = 0;
};

/// Of `faceCount` faces with a thickness, spread evenly. Brute force begins with the thickness times 1.5, or it finds a
/// smaller ball; a thickness that is too small for lack of a wall shows as a larger result.
Differences compare(const Mesh& mesh, const std::vector<double>& values, uint32_t faceCount) {
  const test::BruteForceThickness exact(mesh, makeOpposingWalls(ThicknessOptions{}.wallAngleDegrees).cosine);
  const double diagonal = boundsOfFiniteVertices(mesh).diagonal();
  std::vector<uint32_t> faces;
  const uint32_t step = std::max(1u, mesh.faceCount() / faceCount);
  for (uint32_t face = 0; face < mesh.faceCount(); face += step)
    if (std::isfinite(values[face])) faces.push_back(face);
  std::vector<double> expected(faces.size());
  tbb::parallel_for(size_t{0}, faces.size(),
                    [&](size_t i) { expected[i] = exact.of(faces[i], 1.5 * values[faces[i]]); });
  Differences result{.sampled = faces.size()};
  for (size_t i = 0; i < faces.size(); ++i) {
    // Without an opposing wall the thickness is the least ray, and the ball stays as it began.
    if (expected[i] == 1.5 * values[faces[i]]) continue;
    const double difference = std::abs(expected[i] - values[faces[i]]);
    ++result.count;
    result.within += difference <= 1e-4 * diagonal ? 1 : 0;
    result.worstRelative = std::max(result.worstRelative, difference / expected[i]);
    if (difference / diagonal < result.worst) continue;
    result.worst = difference / diagonal;
    result.worstFace = faces[i];
  }
  return result;
}

void printAgreement(const std::string& name, Session& session, const Mesh& mesh, uint32_t faces,
                    const RunControl& control) {
  const Differences d = compare(mesh, thicknessOf(session, mesh, control), faces);
  writeOutput(fmt::format(
      "| {} | {} | {} of {} | {:.2f} % | {:.1e} (face {}) |\n", name, session.backend(), d.count, d.sampled,
      100 * static_cast<double>(d.within) / static_cast<double>(std::max<size_t>(1, d.count)), d.worst, d.worstFace));
}

/// Distance of shapes with a known thickness from it. height: of the barycentres that are compared, from the middle.
void printShape(const std::string& name, Session& session, const Mesh& mesh, double diameter, double height,
                uint32_t faces, const RunControl& control) {
  const std::vector<double> values = thicknessOf(session, mesh, control);
  double worst = 0;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    double z = 0, top = 0;
    for (const uint32_t vertex : mesh.faces[face]) {
      z += mesh.vertices[vertex].z / 3;
      top = std::max(top, std::abs(mesh.vertices[vertex].z));
    }
    if (std::abs(z) <= height && std::isfinite(values[face]))
      worst = std::max(worst, std::abs(values[face] / diameter - 1));
  }
  writeOutput(fmt::format("| {} | {} | {:.1e} | {:.1e} |\n", name, mesh.faceCount(), worst,
                          compare(mesh, values, faces).worstRelative));
}

void printShapes(Session& session, uint32_t faces, const RunControl& control) {
  writeOutput(
      "| shape | faces | worst relative distance from the smooth shape | from brute force |\n|---|---|---|---|\n");
  for (const uint64_t count : {1000, 4000, 16000}) {
    printShape("sphere", session, makeSphere(count).mesh, 2, 2, faces, control);
    printShape("cylinder, middle", session, makeCylinder(count).mesh, 0.5, 1, faces, control);
    printShape("torus", session, makeTorus(count).mesh, 0.6, 2, faces, control);
  }
  // Compared at the wide walls only: the thickness of the rim is the width.
  Mesh slab = makeSlab(4000, {.width = 2, .thickness = 0.1}).mesh;
  std::erase_if(slab.faces, [&](const Face& face) {
    return std::any_of(face.begin(), face.end(),
                       [&](uint32_t v) { return slab.vertices[v].z != slab.vertices[face[0]].z; });
  });
  printShape("slab, wide walls", session, slab, 0.1, 2, faces, control);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  Program program("asdfvk-bench-thickness", "Time and accuracy of the wall thickness of all faces.");
  program.addOptionalMeshes(arguments.meshes, "none");
  program.add("--backends", arguments.backends, "Backends");
  program.add("--runs", arguments.runs, "Runs per measurement; 0: no times");
  program.add("--faces", arguments.faces, "Faces per mesh that brute force judges; 0: none",
              Range<uint32_t>{0, 100000});
  program.add("--shapes", arguments.shapes, "Also shapes with a known thickness, on the first backend");
  return program.run(argc, argv, [&](const RunControl& control) {
    writeProgress(toText(thisMachine()));
    std::vector<std::unique_ptr<Session>> sessions;
    for (const std::string& name : arguments.backends)
      sessions.push_back(std::make_unique<Session>(sessionOptionsOf(name, "")));
    const auto forEachPair = [&](const auto& print) {
      for (const std::string& path : arguments.meshes) {
        const Mesh mesh = readMesh(path);
        for (const auto& session : sessions) print(std::filesystem::path(path).stem().string(), *session, mesh);
      }
    };
    if (arguments.runs > 0 && !arguments.meshes.empty())
      writeOutput("| mesh | backend | diameter, CPU s | thickness, CPU s | ratio |\n|---|---|---|---|---|\n");
    if (arguments.runs > 0)
      forEachPair([&](const std::string& name, Session& session, const Mesh& mesh) {
        printTimes(name, session, mesh, arguments.runs, control);
      });
    if (arguments.faces > 0 && !arguments.meshes.empty())
      writeOutput("| mesh | backend | judged faces | within 1e-4 of the diagonal | worst |\n|---|---|---|---|---|\n");
    if (arguments.faces > 0)
      forEachPair([&](const std::string& name, Session& session, const Mesh& mesh) {
        printAgreement(name, session, mesh, arguments.faces, control);
      });
    if (arguments.shapes) printShapes(*sessions.front(), std::max(1u, arguments.faces), control);
  });
}
