// How fast the tracers are beside Embree, the best there is for a CPU, and beside CGAL, which people use: the same mesh
// and rays, in one run, turn by turn.
#include "bench_program.h"
#include "cli/terminal.h"
#include "comparison.h"
#include "comparison_report.h"
#include "machine.h"

namespace {

using namespace asdfvk;

struct Arguments {
  std::vector<std::string> meshes;
  bench::ComparisonRequest request;
  bool json = false;
};

void bind(bench::BenchProgram& program, Arguments& arguments) {
  program.addMeshes(arguments.meshes);
  program.add("--runs", arguments.request.roundCount, "Counted rounds, after one that warms up", {1, 1000});
  program.add("--cgal-runs", arguments.request.cgalRunCount,
              "Runs of CGAL, which takes long, spread among the rounds: one in a round at most, 0 for none");
  program.add("--seeds", arguments.request.seeds, "Shares, counts or all");
  program.add("--device", arguments.request.device, "Vulkan device, as asdf-vk takes it");
  program.add("--json", arguments.json, "One JSON line per mesh instead of a table");
}

void run(const Arguments& arguments, const RunControl& control) {
  for (const std::string& mesh : arguments.meshes) {
    const bench::Comparison comparison = bench::compare(mesh, arguments.request, control);
    const bench::Machine machine = bench::thisMachine();
    writeStandardOutput(arguments.json ? comparisonJson(comparison, machine) : comparisonTable(comparison, machine));
  }
}

}  // namespace

int main(int argc, char** argv) {
  bench::BenchProgram program("asdfvk-bench-compare",
                              "Compares asdf-vk's backends with bare Embree and with CGAL, turn by turn in one run.");
  Arguments arguments;
  bind(program, arguments);
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
