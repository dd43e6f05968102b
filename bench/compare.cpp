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

void bind(CLI::App& app, Arguments& arguments) {
  app.add_option("meshes", arguments.meshes, "Meshes")->option_text("MESH...")->required();
  app.add_option("--runs", arguments.request.roundCount, "Counted rounds, after one that warms up")
      ->check(CLI::Range(1u, 1000u))
      ->capture_default_str();
  app.add_option("--cgal-runs", arguments.request.cgalRunCount,
                 "Runs of CGAL, which takes long, spread among the rounds: one in a round at most, 0 for none")
      ->capture_default_str();
  app.add_option("--seeds", arguments.request.seeds, "Shares, counts or all")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  app.add_option("--device", arguments.request.device, "Vulkan device, as asdf-vk takes it");
  app.add_flag("--json", arguments.json, "One JSON line per mesh instead of a table");
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
  CLI::App app("Compares asdf-vk's backends with bare Embree and with CGAL, turn by turn in one run.",
               "asdfvk-bench-compare");
  Arguments arguments;
  bind(app, arguments);
  return bench::runBenchProgram(app, argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
