// Prints how much the parts of a mesh change if the mesh changes in a way that people do not see: the Rand
// dissimilarity, weighted by area, between the parts of the mesh and those of the changed mesh. 0 is the same.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "asdf_vk/files.h"
#include "mesh_changes.h"
#include "segment/rand_index.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"
#include "trace/nearest_point.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Change {
  const char* name;
  std::function<ChangedMesh(const Mesh&)> make;
  const char* seeds = "10%";
  uint64_t randomSeed = 1;
};

std::vector<Change> allChanges() {
  const auto keep = [](const Mesh& mesh) { return unchanged(mesh); };
  return {{"noise 0.05%", [](const Mesh& mesh) { return addNoise(mesh, 0.0005); }},
          {"noise 0.2%", [](const Mesh& mesh) { return addNoise(mesh, 0.002); }},
          {"divided", divideFaces},
          {"turned", turn},
          {"seed", keep, "10%", 2},
          {"all rays", keep, "all"},
          {"half", [](const Mesh& mesh) { return decimate(mesh, 0.5); }},
          {"tenth", [](const Mesh& mesh) { return decimate(mesh, 0.1); }},
          {"flipped", flipEdges},
          {"holes", [](const Mesh& mesh) { return removeDiscs(mesh, 8, 0.015); }}};
}

struct SegmentedMesh {
  TraceableMesh mesh;
  std::vector<uint32_t> parts;
  uint32_t partCount = 0;

  SegmentedMesh(Session& session, Mesh source, const Change& change, const RunControl& control)
      : mesh(std::move(source)) {
    Options options;
    options.seeds = parseSeedCount(change.seeds);
    options.randomSeed = change.randomSeed;
    options.estimatesError = false;
    options.segmentation = Segmentation::Parts;
    const Result result = session.compute(mesh.mesh, options, control);
    parts = std::get<std::vector<uint32_t>>(result.field("segment")->values);
    partCount = *result.report.segmentCount;
  }

  [[nodiscard]] std::vector<float> areas() const {
    const auto& areas = mesh.prepared.geometry.areas;
    return {areas.begin(), areas.end()};
  }
  /// The part of the face nearest to a point in the unit of the mesh.
  [[nodiscard]] uint32_t partAt(const Vec3d& point) const {
    const TraceScene scene = mesh.scene();
    const auto keep = [](uint32_t face) { return face; };
    return parts[nearestSurfacePoint(scene, scene.bvh.normalization.toNormalized(point), 0, keep).face];
  }
};

/// originalFaces: as in ChangedMesh; empty: faces are compared with the nearest face of the other mesh.
double dissimilarity(const SegmentedMesh& original, const SegmentedMesh& changed,
                     const std::vector<uint32_t>& originalFaces) {
  std::vector<uint32_t> labels;
  if (!originalFaces.empty()) {
    for (const uint32_t face : originalFaces) labels.push_back(original.parts[face]);
    return 1 - randIndex(labels, changed.parts, changed.areas());
  }
  for (const Vec3d& point : original.mesh.prepared.geometry.barycentres) labels.push_back(changed.partAt(point));
  return 1 - randIndex(original.parts, labels, original.areas());
}

struct Row {
  std::vector<double> dissimilarities;
  uint32_t partCount = 0;
};

void printTable(const std::vector<Change>& changes, const std::vector<Row>& rows, double originalCount) {
  std::string text = fmt::format("{}\n\n| change | mean | worst | parts |\n|---|---|---|---|\n", toText(thisMachine()));
  for (size_t i = 0; i < changes.size(); ++i) {
    const std::vector<double>& list = rows[i].dissimilarities;
    double sum = 0;
    for (const double value : list) sum += value;
    const auto count = static_cast<double>(list.size());
    text += fmt::format("| {} | {:.3f} | {:.2f} | {:.1f} |\n", changes[i].name, sum / count,
                        *std::max_element(list.begin(), list.end()), rows[i].partCount / count);
  }
  writeOutput(text + fmt::format("| none | | | {:.1f} |\n", originalCount));
}

struct Arguments {
  std::vector<std::string> paths;
  uint32_t every = 1;
  bool comparesTwo = false, listsMeshes = false;
};

void run(const Arguments& arguments, const RunControl& control) {
  const std::vector<std::string>& paths = arguments.paths;
  Session session({.backend = BackendChoice::Cpu});
  const std::vector<Change> changes = allChanges();
  const Change none{"none", nullptr};
  if (arguments.comparesTwo) {
    const SegmentedMesh a(session, readMesh(paths.at(0)), none, control),
        b(session, readMesh(paths.at(1)), none, control);
    writeOutput(fmt::format("{} and {} parts, dissimilarity {:.3f} and {:.3f}\n", a.partCount, b.partCount,
                            dissimilarity(a, b, {}), dissimilarity(b, a, {})));
    return;
  }
  std::vector<Row> rows(changes.size());
  double originalCount = 0;
  uint32_t meshCount = 0;
  for (size_t at = arguments.every / 2; at < paths.size(); at += arguments.every, ++meshCount) {
    const std::string& path = paths[at];
    const Mesh mesh = readMesh(path);
    const SegmentedMesh original(session, mesh, none, control);
    originalCount += original.partCount;
    std::string line = fmt::format("{} {} parts:", path, original.partCount);
    for (size_t i = 0; i < changes.size(); ++i) {
      ChangedMesh changed = changes[i].make(mesh);
      const SegmentedMesh segmented(session, std::move(changed.mesh), changes[i], control);
      rows[i].dissimilarities.push_back(dissimilarity(original, segmented, changed.originalFaces));
      rows[i].partCount += segmented.partCount;
      line += fmt::format(" {} {:.3f} ({})", changes[i].name, rows[i].dissimilarities.back(), segmented.partCount);
    }
    if (arguments.listsMeshes) writeOutput(line + "\n");
  }
  if (meshCount == 0) throw Error(ErrorCode::EmptyMesh, "there are fewer meshes than --every needs");
  printTable(changes, rows, originalCount / std::max(meshCount, 1u));
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-part-changes",
                  "Change of --segment parts by changes of the mesh that people do not see.");
  Arguments arguments;
  program.addMeshes(arguments.paths);
  program.add("--every", arguments.every, "Use each n-th mesh only, from the (n / 2)-th on", {1, 1000});
  program.add("--two", arguments.comparesTwo, "Compare the parts of two meshes of one shape instead");
  program.add("--meshes", arguments.listsMeshes, "Also print a line per mesh");
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
