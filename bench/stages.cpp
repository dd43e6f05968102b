// Where the time of a whole run goes, file to file: stage by stage, reference against Vulkan, at several shares of
// seeds.
#include "bench_program.h"
#include "cli/terminal.h"
#include "generate/creatures.h"
#include "generate/generated_ply.h"
#include "machine.h"
#include "stage_json.h"
#include "stage_measurement.h"
#include "stage_table.h"
#include "temporary_folder.h"

namespace {

using namespace asdfvk;

struct Arguments {
  std::vector<std::string> meshes;
  bench::StageRequest request{{"all", "10%", "1%"}, {"reference", "vulkan"}, {}, 5};
  uint64_t generatedFaceCount = 100'000;
  bool json = false;
  bool cold = false;
};

void run(const Arguments& arguments, const RunControl& control) {
  const bench::StageRequest& request = arguments.request;
  if (arguments.cold) {
    writeStandardOutput(bench::coldRunText(arguments.meshes.at(0), request.seeds.at(0), request.backends.at(0),
                                           request.device, control));
    return;
  }
  bench::StageBench stages(request);
  const auto measure = [&](const std::string& name, const std::filesystem::path& path) {
    const bench::StageMeasurement measurement = stages.measure(name, path, control);
    const bench::Machine machine = bench::thisMachine();
    writeStandardOutput(arguments.json ? stageJson(measurement, machine) : stageTable(measurement, machine));
  };
  for (const std::string& mesh : arguments.meshes) measure(mesh, mesh);
  if (!arguments.meshes.empty()) return;
  const bench::TemporaryFolder folder;
  const std::filesystem::path animal = folder.path() / "animal.ply";
  writeGeneratedPly(animal, makeAnimal(arguments.generatedFaceCount), false);
  measure("generated animal", animal);
}

}  // namespace

int main(int argc, char** argv) {
  bench::BenchProgram program("asdfvk-bench-stages",
                              "Times each stage of asdf-vk, reference against Vulkan, turn by turn in one run.");
  Arguments arguments;
  program.addMeshesOr(arguments.meshes, "an animal is generated");
  program.add("--faces", arguments.generatedFaceCount, "Faces of the generated animal", {kMinFaceCount, kMaxFaceCount});
  program.add("--runs", arguments.request.runCount, "Counted rounds, after one that warms up", {1, 1000});
  program.add("--seeds", arguments.request.seeds, "Shares, counts or all");
  program.add("--backends", arguments.request.backends, "Some of reference, vulkan and cpu");
  program.add("--device", arguments.request.device, "As asdf-vk takes it");
  program.add("--json", arguments.json, "One JSON line per row instead of a table");
  program.addHidden("--cold", arguments.cold);  // What StageBench starts further processes with.
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
