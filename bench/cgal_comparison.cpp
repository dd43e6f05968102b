// Does the segmentation agree with CGAL's, and how do their times compare? Values by CGAL's rays, post-processing and
// segments by both, from the same input.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asdf_vk/files.h"
#include "segment/cgal_postprocess.h"
#include "segment/cgal_segmentation.h"
#include "support/cgal_oracle.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Setting {
  uint32_t clusterCount;
  double smoothness;
};
constexpr std::array<Setting, 5> kSettings{{{5, 0.26}, {3, 0.20}, {2, 0.09}, {5, 0.08}, {5, 0.10}}};

/// CPU seconds of all threads, so that other processes disturb little and our threads gain nothing.
template <typename Task>
double secondsOf(const Task& task) {
  const Timer timer(Clock::ProcessCpu);
  task();
  return timer.seconds();
}

struct Row {
  uint32_t faceCount = 0, missingCount = 0;
  bool isChanged = false;       ///< CGAL split vertices or turned faces.
  double maxDifference = 0;     ///< Of the normalised values.
  uint64_t unequalCount = 0;    ///< Labels, over all settings.
  std::string unequalSettings;  ///< "5/0.26: 17, ..."
  double energyRatio = 0;       ///< Of all labels expanded over the first only; least over the settings.
  std::vector<double> postprocess, first, all;  ///< Seconds of CGAL over ours.
};

Row compare(const std::string& path, uint32_t runCount) {
  const Mesh source = readMesh(path);
  test::CgalOracle oracle(source);
  const Mesh& mesh = oracle.mesh();
  Row row{.faceCount = mesh.faceCount(), .energyRatio = 1};
  row.isChanged = mesh.faces != source.faces;
  const std::vector<double> raw = oracle.rawValues();
  row.missingCount = static_cast<uint32_t>(std::count_if(raw.begin(), raw.end(), [](double v) { return v != v; }));
  if (row.missingCount == row.faceCount) return row;
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  const FaceNeighbours neighbours = findFaceNeighbours(mesh);
  test::CgalOracle::Values expected;
  for (uint32_t run = 0; run < runCount; ++run) {
    CgalValues values;
    const double cgal = secondsOf([&] { expected = oracle.postprocess(raw); });
    row.postprocess.push_back(cgal / secondsOf([&] { values = postprocessLikeCgal(neighbours, raw); }));
    for (size_t face = 0; face < raw.size(); ++face)
      row.maxDifference = std::max(row.maxDifference, std::abs(values.normalized[face] - expected.normalized[face]));
  }
  for (const auto& [clusterCount, smoothness] : kSettings)
    for (uint32_t run = 0; run < runCount; ++run) {
      std::vector<uint32_t> segments;
      CgalSegmentation first, all;
      const double cgal = secondsOf([&] { segments = oracle.segment(expected.normalized, clusterCount, smoothness); });
      const auto segment = [&](CgalExpansion expansion) {
        return segmentLikeCgal(geometry, mesh, neighbours, expected.normalized, {clusterCount, smoothness, expansion});
      };
      row.first.push_back(cgal / secondsOf([&] { first = segment(CgalExpansion::First); }));
      row.all.push_back(cgal / secondsOf([&] { all = segment(CgalExpansion::All); }));
      if (run > 0) continue;
      row.energyRatio = std::min(row.energyRatio, all.energy / first.energy);
      uint64_t unequal = 0;
      for (size_t face = 0; face < segments.size(); ++face) unequal += segments[face] != first.segments[face] ? 1 : 0;
      row.unequalCount += unequal;
      if (unequal > 0) row.unequalSettings += fmt::format(" {}/{:.2f}: {}", clusterCount, smoothness, unequal);
    }
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-cgal-comparison",
                  "Compares post-processing and segmentation with CGAL's, from the same values.");
  std::vector<std::string> meshes;
  uint32_t runCount = 3;
  program.addMeshes(meshes);
  program.add("--runs", runCount, "Timed runs per mesh and setting", {1, 1000});
  return program.run(argc, argv, [&](const RunControl& control) {
    writeOutput(fmt::format(
        "{}\nCPU seconds of CGAL over ours, median; unequal labels of {} settings; \"*\": CGAL split vertices\n\n"
        "| mesh | faces | without value | largest difference | post-process | unequal labels | first | all | least "
        "energy all / first |\n|---|---|---|---|---|---|---|---|---|\n",
        toText(thisMachine()), kSettings.size()));
    for (const std::string& mesh : meshes) {
      control.checkpoint(0);
      const Row row = compare(mesh, runCount);
      writeOutput(fmt::format("| {}{} | {} | {} | {:.1e} | {:.1f} | {}{} | {:.1f} | {:.1f} | {:.4f} |\n",
                              mesh.substr(mesh.rfind('/') + 1), row.isChanged ? "*" : "", row.faceCount,
                              row.missingCount, row.maxDifference, dispersionOf(row.postprocess).median,
                              row.unequalCount, row.unequalSettings, dispersionOf(row.first).median,
                              dispersionOf(row.all).median, row.energyRatio));
    }
    writeOutput(toText(thisMachine()) + "\n");
  });
}
