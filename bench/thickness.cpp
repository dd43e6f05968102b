// Measures accuracy and time of the wall thickness. Compares the values of the backends with brute force over all pairs
// of triangles in double. Compares the least thickness of generated parts with the known thickness. Compares times with
// the times of the shape diameter.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "asdf_vk/files.h"
#include "cone/opposing_walls.h"
#include "generate/thickness_parts.h"
#include "support/brute_force_thickness.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"
#include "trace/face_balls.h"
#include "trace/greatest_section.h"
#include "trace/solids.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

constexpr std::array kFields{"thickness", "least_thickness"};
constexpr double kPartLimit = 0.8;

struct Arguments {
  std::vector<std::string> meshes, backends{"reference", "cpu", "vulkan"};
  uint32_t runs = 5, faces = 1000;
  bool parts = false;
  double longestEdge = 0.5;
};

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

Options checkOptions(double limit, bool countsEdges = false) {
  Options options;
  options.measure = Measure::Thickness;
  options.thickness.thinnerThan = limit;
  options.thickness.countsEdges = countsEdges;
  return options;
}

/// The fields thickness and least_thickness at some faces, by brute force. The values are limited to the
/// GreatestSection of the solid of each face.
struct Truth {
  struct Section {
    double diameter, bound;  // The members of GreatestSection with these names.
  };
  std::vector<uint32_t> faces;
  std::vector<Section> sections;
  std::array<std::vector<double>, kFields.size()> values;
  double diagonal = 0;

  Truth(const Mesh& mesh, uint32_t faceCount) {
    const TraceableMesh traceable(mesh);
    const TraceScene scene = traceable.scene();
    const Normalization& normalization = scene.bvh.normalization;
    diagonal = scene.geometry.bounds.diagonal();
    const Solids solids = findSolids(scene.mesh, traceable.prepared.components);
    std::vector<Section> all(solids.isClosed.size(), {kUnlimited, kUnlimited});
    const std::vector<GreatestSection> found =
        findGreatestSections(scene, solids.solidOf, solids.isClosed, SectionSearch{}, {});
    for (size_t solid = 0; solid < all.size(); ++solid)
      if (solids.isClosed[solid] != 0)
        all[solid] = {normalization.toMeshLength(found[solid].diameter),
                      normalization.toMeshLength(found[solid].bound)};
    const uint32_t step = std::max(1u, mesh.faces.size() <= faceCount ? 1 : scene.mesh.faceCount() / faceCount);
    for (uint32_t face = 0; face < scene.mesh.faceCount(); face += step)
      if (!scene.geometry.isDegenerate(face)) faces.push_back(face);
    for (const uint32_t face : faces) sections.push_back(all[solids.solidOf[face]]);
    const test::BruteForceThickness twin(mesh, makeOpposingWalls({}).cosine, normalization.contactLength());
    for (auto& list : values) list.resize(faces.size());
    tbb::parallel_for(size_t{0}, faces.size(), [&](size_t i) {
      values[0][i] = twin.at(faces[i]);
      values[1][i] = twin.least(faces[i]);
    });
  }

  /// Difference divided by the diagonal; infinite if only one of the two values exists.
  [[nodiscard]] double difference(size_t field, size_t i, double found) const {
    const double expected = values[field][i];
    double least = kUnlimited;
    const auto offer = [&](double candidate) {
      if (std::isinf(candidate) && std::isnan(found)) least = 0;
      if (std::isfinite(candidate) && !std::isnan(found))
        least = std::min(least, std::abs(candidate - found) / diagonal);
    };
    if (expected < sections[i].bound * (1 + 1e-9)) offer(expected);
    if (expected >= sections[i].bound * (1 - 1e-9)) offer(sections[i].diameter);
    return least;
  }

 private:
  static constexpr double kUnlimited = std::numeric_limits<double>::infinity();
};

void printAgreement(const NamedMesh& named, Session& session, const Truth& truth, const RunControl& control) {
  const Result result = session.compute(named.mesh, checkOptions(0.01 * truth.diagonal), {control.stop, {}});
  for (size_t field = 0; field < kFields.size(); ++field) {
    const std::vector<double>& found = *result.field(kFields[field])->reals();
    size_t within6 = 0, within4 = 0;
    double worst = 0;
    uint32_t worstFace = 0;
    for (size_t i = 0; i < truth.faces.size(); ++i) {
      const double difference = truth.difference(field, i, found[truth.faces[i]]);
      within6 += difference <= 1e-6 ? 1 : 0;
      within4 += difference <= 1e-4 ? 1 : 0;
      if (difference <= worst) continue;
      worst = difference;
      worstFace = truth.faces[i];
    }
    const auto share = [&](size_t count) {
      return 100 * static_cast<double>(count) / static_cast<double>(std::max<size_t>(1, truth.faces.size()));
    };
    writeOutput(fmt::format("| {} | {} | {} | {} | {:.2f} % | {:.2f} % | {:.1e} (face {}) |\n", named.name,
                            session.backend(), kFields[field], truth.faces.size(), share(within6), share(within4),
                            worst, worstFace));
  }
}

/// CPU seconds of computations in memory, without reading and writing. The computations alternate, after a warm-up.
void printTimes(const NamedMesh& named, Session& session, uint32_t runs, const RunControl& control) {
  Options diameterOptions;
  diameterOptions.seeds = SeedCount::all();
  const Options thicknessOptions = checkOptions(0.01 * boundsOfFiniteVertices(named.mesh).diagonal());
  const auto secondsOf = [&](const Options& options) {
    const Timer timer(Clock::ProcessCpu);
    (void)session.compute(named.mesh, options, {control.stop, {}});
    return timer.seconds();
  };
  std::vector<double> diameter, thickness;
  for (uint32_t run = 0; run <= runs; ++run) {
    const double first = secondsOf(diameterOptions), second = secondsOf(thicknessOptions);
    if (run == 0) continue;
    diameter.push_back(first);
    thickness.push_back(second);
  }
  writeOutput(fmt::format("| {} | {} | {} | {} | {} | {} |\n", named.name, named.mesh.faces.size(), session.backend(),
                          toText(dispersionOf(diameter), 3), toText(dispersionOf(thickness), 3),
                          toText(ratioOf(thickness, diameter), 2)));
}

/// The narrowest angle of an edge that is not a wall.
constexpr double kEdgeDegrees = 17;

/// Prints least thickness and verdict of each part, with few faces and with divided edges.
void printParts(Session& session, double longestEdge, const RunControl& control) {
  writeOutput(
      fmt::format("| part | faces | known | {} | relative difference | verdict at {} | edges counted |\n"
                  "|---|---|---|---|---|---|---|\n",
                  session.backend(), kPartLimit));
  size_t wrongCount = 0;
  for (const std::string_view name : thicknessPartNames()) {
    const ThicknessPart part = makeThicknessPart(name);
    const bool hasWall =
        part.leastWall < kPartLimit || (part.sharpAngleDegrees > 0 && part.sharpAngleDegrees < kEdgeDegrees);
    for (const double edge : {SurfaceDivision{}.longestEdge, longestEdge}) {
      const Mesh mesh = part.solid.surface({.longestEdge = edge});
      const auto check = [&](bool countsEdges) {
        return session.compute(mesh, checkOptions(kPartLimit, countsEdges), {control.stop, {}});
      };
      const Result result = check(false), counted = check(true);
      const std::vector<double>& values = *result.field("least_thickness")->reals();
      const double least = *std::min_element(values.begin(), values.end());
      const double unit = part.leastThickness > 0 ? part.leastThickness : 1;
      const double difference = std::abs(least - part.leastThickness) / unit;
      const auto verdict = [&](const Result& found, bool isThin) {
        const ThicknessVerdict measured = found.report.thickness->verdict.value();
        const bool isRight = measured == (isThin ? ThicknessVerdict::Failed : ThicknessVerdict::Passed);
        return fmt::format("{}{}", nameOf(measured), isRight ? "" : ", wrong");
      };
      const std::string verdicts =
          verdict(result, hasWall) + " | " + verdict(counted, part.leastThickness < kPartLimit);
      wrongCount += difference <= 1e-6 && verdicts.find("wrong") == std::string::npos ? 0 : 1;
      writeOutput(fmt::format("| {} | {} | {:.6g} | {:.6g} | {:.1e} | {} |\n", name, mesh.faces.size(),
                              part.leastThickness, least, difference, verdicts));
    }
  }
  writeOutput(fmt::format("\n{} of {} wrong\n", wrongCount, 2 * thicknessPartNames().size()));
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  Program program("asdfvk-bench-thickness", "Accuracy and time of the wall thickness of all faces.");
  program.addOptionalMeshes(arguments.meshes, "none");
  program.add("--backends", arguments.backends, "Backends");
  program.add("--runs", arguments.runs, "Runs per measurement of time; 0: none");
  program.add("--faces", arguments.faces,
              "Number of faces per mesh that are compared with brute force, at least; 0: none",
              Range<uint32_t>{0, 100000});
  program.add("--parts", arguments.parts, "Generated parts with known least thickness, coarse and refined");
  program.add("--edge", arguments.longestEdge, "Longest edge of the refined parts", Range<double>{0.05, 100});
  return program.run(argc, argv, [&](const RunControl& control) {
    writeProgress(toText(thisMachine()));
    std::vector<std::unique_ptr<Session>> sessions;
    for (const std::string& name : arguments.backends)
      sessions.push_back(std::make_unique<Session>(sessionOptionsOf(name, "")));
    std::vector<NamedMesh> meshes;
    for (const std::string& path : arguments.meshes) {
      meshes.push_back({std::filesystem::path(path).stem().string(), readMesh(path)});
      meshes.back().mesh.polygons = {};  // Values are compared per triangle.
    }
    if (arguments.parts)
      for (const auto& session : sessions) printParts(*session, arguments.longestEdge, control);
    if (arguments.faces > 0 && !meshes.empty())
      writeOutput(
          "| mesh | backend | field | judged faces | within 1e-6 of the diagonal | 1e-4 | worst |\n"
          "|---|---|---|---|---|---|---|\n");
    for (const NamedMesh& named : meshes) {
      if (arguments.faces == 0) break;
      const Truth truth(named.mesh, arguments.faces);
      for (const auto& session : sessions) printAgreement(named, *session, truth, control);
    }
    if (arguments.runs > 0 && !meshes.empty())
      writeOutput(
          "| mesh | faces | backend | diameter of all faces, CPU s | check, CPU s | ratio "
          "|\n|---|---|---|---|---|---|\n");
    for (const NamedMesh& named : meshes)
      for (const auto& session : sessions)
        if (arguments.runs > 0) printTimes(named, *session, arguments.runs, control);
  });
}
