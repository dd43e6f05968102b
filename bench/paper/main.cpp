// Repeats the evaluation of the ASDF paper. Writes the numbers of the paper's tables and plots as CSV files, and the
// paper's pictures as PNG files. bench/plot_paper.py makes plots and a page from these files.
#include <fmt/format.h>

#include "generate/generated_shape.h"
#include "paper/figures.h"
#include "paper/tables.h"
#include "support/computation.h"
#include "support/measurement.h"
#include "support/program.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Arguments {
  std::vector<std::string> meshes;
  std::string output, backend = "auto", device;
  EvaluationOptions evaluation;
  uint64_t generatedFaceCount = 10'000;
  std::string commandLine;
};

CsvTable runTable(const Arguments& arguments, const Report& report) {
  const Machine machine = thisMachine();
  return {{"name", "value"},
          {{"version", std::string("asdf-vk ") + ASDFVK_VERSION},
           {"device", fmt::format("{} ({})", report.device, report.backend)},
           {"processor", fmt::format("{}, threads: {}", machine.processor, machine.threads)},
           {"random seed sets", std::to_string(arguments.evaluation.seedSetCount)},
           {"rays per face of the truth", std::to_string(arguments.evaluation.truthRayCount)},
           {"command", arguments.commandLine}}};
}

void run(const Arguments& arguments, const RunControl& control) {
  std::vector<NamedMesh> meshes =
      arguments.meshes.empty() ? generateMeshes(arguments.generatedFaceCount) : readMeshes(arguments.meshes);
  Session session(sessionOptionsOf(arguments.backend, arguments.device));
  const OutputFolder folder(arguments.output);
  std::vector<Evaluation> evaluations;
  for (NamedMesh& mesh : meshes) evaluations.push_back(evaluate(session, mesh, arguments.evaluation, control));
  folder.write("run.csv", runTable(arguments, evaluations.front().full.report));
  folder.write("meshes.csv", meshTable(evaluations));
  folder.write("table1.csv", errorTable(evaluations));
  folder.write("figure6.csv", timeTable(evaluations));

  PictureWriter pictures(folder, control);
  FigurePages pages;
  drawMeshFigures(pictures, pages, session, meshes.front(), evaluations.front(), control);
  folder.write("figure7.csv", drawSamplers(pictures, pages, session, meshes.front(), evaluations.front(),
                                           arguments.evaluation.seedSetCount, control));
  drawAllMeshes(pictures, pages, session, meshes, control);
  folder.write("pictures.csv", pictures.list());
  pages.write(folder);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  Program program("asdfvk-bench-paper",
                  "Repeats the evaluation of the ASDF paper: CSV files and pictures, from which bench/plot_paper.py\n"
                  "makes plots and a page. The first mesh takes the place of the paper's horse.");
  program.addOptionalMeshes(arguments.meshes, "a generated animal, hand and figure");
  program.addRequired("-o,--output", arguments.output, "DIR", "Output folder; made if it does not exist");
  program.add("--seed-sets", arguments.evaluation.seedSetCount,
              "Number of random seed sets; results are medians over the sets", {1, 1000});
  program.add("--truth-rays", arguments.evaluation.truthRayCount, "Rays per face of the truth", {1, kMaxRayCount});
  program.add("--faces", arguments.generatedFaceCount, "Faces of each generated mesh", {kMinFaceCount, kMaxFaceCount});
  program.add("--backend", arguments.backend, "auto, vulkan, cpu or reference");
  program.add("--device", arguments.device, "Vulkan device: index or part of its name");
  arguments.commandLine = "asdfvk-bench-paper";
  for (int i = 1; i < argc; ++i) arguments.commandLine.append(" ").append(argv[i]);
  return program.run(argc, argv, [&](const RunControl& control) { run(arguments, control); });
}
