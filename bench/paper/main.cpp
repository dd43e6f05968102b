// The evaluation of the ASDF paper as one command: its tables, plots and pictures as a page in a folder, each number
// beside the paper's where there is one, and beside what a function of many rays says.
#include <fmt/format.h>

#include <vector>

#include "bench_program.h"
#include "cli/choice_names.h"
#include "cli/report_text.h"
#include "core/text.h"
#include "generate/generated_shape.h"
#include "machine.h"
#include "paper/gallery.h"
#include "paper/paper_figures.h"
#include "paper/report.h"
#include "paper/sampler_figure.h"

namespace {

using namespace asdfvk;
using namespace asdfvk::bench;

struct Arguments {
  std::vector<std::string> meshes;
  std::string output;
  EvaluationOptions evaluation;
  uint64_t generatedFaceCount = 10'000;
  SessionOptions session;
  std::string commandLine;
};

/// As a shell reads it.
std::string quotedForShell(const std::string& argument) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./=:,%+@";
  if (!argument.empty() && argument.find_first_not_of(kPlain) == std::string::npos) return argument;
  std::string quoted = "'";
  for (const char c : argument) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

void addFacts(Page& page, const Arguments& arguments, const std::vector<Evaluation>& evaluations) {
  const Report& report = evaluations.front().full.report;
  const Machine machine = thisMachine();
  std::string meshes;
  for (const Evaluation& evaluation : evaluations)
    meshes += fmt::format("{}{} ({} faces)", meshes.empty() ? "" : ", ", evaluation.name,
                          groupDigits(evaluation.full.report.faceCount));
  page.facts(
      {{"version", std::string("asdf-vk ") + ASDFVK_VERSION},
       {"device", fmt::format("{} ({})", report.device, report.backend)},
       {"processor",
        fmt::format("{}, {} thread{}", machine.processor, machine.threads, machine.threads == 1 ? "" : "s")},
       {"meshes", meshes},
       {"options", fmt::format("{} seed set{}, 30 rays in a cone of 120 degrees, truth of {} rays",
                               arguments.evaluation.seedSetCount, arguments.evaluation.seedSetCount == 1 ? "" : "s",
                               arguments.evaluation.truthRayCount)},
       {"command", arguments.commandLine}});
}

void run(const Arguments& arguments, const RunControl& control) {
  std::vector<Subject> subjects =
      arguments.meshes.empty() ? generateSubjects(arguments.generatedFaceCount) : readSubjects(arguments.meshes);
  Session session(arguments.session);
  const OutputFolder folder(arguments.output);
  std::vector<Evaluation> evaluations;
  for (Subject& subject : subjects)
    evaluations.push_back(evaluate(session, subject.name, subject.mesh, arguments.evaluation, control));

  Page page("The ASDF paper\u2019s evaluation, repeated");
  addFacts(page, arguments, evaluations);
  addTables(page, folder, evaluations, arguments.evaluation);
  addPlots(page, folder, evaluations);
  page.heading("Figures 1 to 4, 7 and 8: pictures");
  const Studio studio(folder, control);
  addPaperFigures(page, studio, session, subjects.front(), evaluations.front(), control);
  addSamplerFigure(page, studio, folder, session, subjects.front(), evaluations.front(),
                   arguments.evaluation.seedSetCount, control);
  addGallery(page, studio, session, subjects, control);
  folder.write("index.html", page.html());
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  BenchProgram program(
      "asdfvk-bench-paper",
      "Tables, plots and pictures of the ASDF paper as a page (DIR/index.html) with CSV, SVG and PNG files.\n"
      "The first mesh takes the place of the paper's horse.");
  program.addMeshesOr(arguments.meshes, "an animal, a hand and a figure are generated");
  program.addRequired("-o,--output", arguments.output, "DIR", "The folder to write to; made where there is none");
  program.add("--seed-sets", arguments.evaluation.seedSetCount, "Random seeds over which medians are taken", {1, 1000});
  program.add("--truth-rays", arguments.evaluation.truthRayCount, "Rays per face of what is called the truth",
              {1, kMaxRayCount});
  program.add("--faces", arguments.generatedFaceCount, "Of each generated shape", {kMinFaceCount, kMaxFaceCount});
  std::vector<std::string> backendNames;
  for (const auto& [name, backend] : kBackends) backendNames.emplace_back(name);
  std::string backend = "auto";
  program.addChoice("--backend", backend, backendNames, "Where to compute; default auto");
  program.add("--device", arguments.session.device, "As asdf-vk takes it");
  arguments.commandLine = "asdfvk-bench-paper";
  for (int i = 1; i < argc; ++i) arguments.commandLine.append(" ").append(quotedForShell(argv[i]));
  return program.run(argc, argv, [&](const RunControl& control) {
    for (const auto& [name, choice] : kBackends)
      if (name == backend) arguments.session.backend = choice;
    run(arguments, control);
  });
}
