// Writes CGAL's result for a mesh: a line per face with its value (0 to 1) and its segment. Used for comparisons.
#include <fmt/format.h>

#include <string>

#include "asdf_vk/files.h"
#include "support/cgal_oracle.h"
#include "support/program.h"

int main(int argc, char** argv) {
  using namespace asdfvk;
  using namespace asdfvk::bench;
  Program program("asdfvk-bench-cgal-oracle", "Writes CGAL's normalised value and segment of each face.");
  std::vector<std::string> meshes;
  uint32_t clusterCount = 5;
  double smoothness = 0.26;
  program.addMeshes(meshes);
  program.add("--clusters", clusterCount, "Clusters of values", {2, 100});
  program.add("--smoothness", smoothness, "Weight of the edge costs");
  return program.run(argc, argv, [&](const RunControl& control) {
    for (const std::string& path : meshes) {
      test::CgalOracle oracle(readMesh(path));
      control.checkpoint(0);
      const std::vector<double> values = oracle.postprocess(oracle.rawValues()).normalized;
      const std::vector<uint32_t> segments = oracle.segment(values, clusterCount, smoothness);
      std::string lines;
      for (size_t face = 0; face < values.size(); ++face) lines += fmt::format("{} {}\n", values[face], segments[face]);
      writeOutput(lines);
    }
  });
}
