// Prints the elapsed seconds for values, post-processing and segments, in asdf-vk and in CGAL, and their ratio. All
// faces cast 25 rays; there are five clusters, and the smoothness is 0.26. The times do not include reading, writing,
// the construction of CGAL's mesh, and the construction of the session.
#include <fmt/format.h>

#include "asdf_vk/files.h"
#include "asdf_vk/session.h"
#include "support/cgal_oracle.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Seconds {
  double values = 0, postprocess = 0, segment = 0;
  [[nodiscard]] double sum() const { return values + postprocess + segment; }
};

Seconds secondsOfCgal(test::CgalOracle& oracle, const CgalSegmentationOptions& options) {
  Seconds seconds;
  const Timer valueTimer(Clock::Wall);
  const std::vector<double> raw = oracle.rawValues();
  seconds.values = valueTimer.seconds();
  const Timer postprocessTimer(Clock::Wall);
  const test::CgalOracle::Values values = oracle.postprocess(raw);
  seconds.postprocess = postprocessTimer.seconds();
  const Timer segmentTimer(Clock::Wall);
  (void)oracle.segment(values.normalized, options.clusterCount, options.smoothness);
  seconds.segment = segmentTimer.seconds();
  return seconds;
}

Seconds secondsOfOurs(Session& session, const Mesh& mesh, const Options& options, const RunControl& control) {
  const Timer timer(Clock::Wall);
  const Result result = session.compute(mesh, options, control);
  Seconds seconds{.postprocess = result.report.stageSeconds[Stage::Postprocess],
                  .segment = result.report.stageSeconds[Stage::Segment]};
  seconds.values = timer.seconds() - seconds.postprocess - seconds.segment;
  return seconds;
}

}  // namespace

int main(int argc, char** argv) {
  Program program("asdfvk-bench-cgal-pipeline",
                  "Compares the time of values, post-processing and segments with CGAL's.");
  std::vector<std::string> meshes, backends{"vulkan", "cpu"};
  uint32_t runCount = 3;
  program.addMeshes(meshes);
  program.add("--backends", backends, "Backends to compare");
  program.add("--runs", runCount, "Runs, in turns with CGAL, after one run for warm-up", {1, 1000});
  return program.run(argc, argv, [&](const RunControl& control) {
    writeOutput(toText(thisMachine()) +
                "\n\n| mesh | backend | expansion | CGAL: values, post-process, segments | ours | CGAL / ours |\n"
                "|---|---|---|---|---|---|\n");
    for (const std::string& path : meshes) {
      const Mesh mesh = readMesh(path);
      test::CgalOracle oracle(mesh);
      for (const std::string& backend : backends) {
        Session session(sessionOptionsOf(backend, ""));
        for (const CgalExpansion expansion : {CgalExpansion::First, CgalExpansion::All}) {
          Options options;
          applyDefinition(Definition::Cgal, options);
          options.segmentation = Segmentation::Cgal;
          options.cgalSegmentation.expansion = expansion;
          (void)secondsOfOurs(session, mesh, options, control);
          std::vector<double> ratios;
          Seconds cgal, ours;
          for (uint32_t run = 0; run < runCount; ++run) {
            cgal = secondsOfCgal(oracle, options.cgalSegmentation);
            ours = secondsOfOurs(session, mesh, options, control);
            ratios.push_back(cgal.sum() / ours.sum());
          }
          writeOutput(fmt::format("| {} | {} | {} | {:.2f}, {:.2f}, {:.2f} | {:.2f}, {:.2f}, {:.2f} | {} |\n",
                                  path.substr(path.rfind('/') + 1), backend,
                                  expansion == CgalExpansion::First ? "first" : "all", cgal.values, cgal.postprocess,
                                  cgal.segment, ours.values, ours.postprocess, ours.segment,
                                  toText(dispersionOf(ratios), 1)));
        }
      }
    }
    writeOutput(toText(thisMachine()) + "\n");
  });
}
