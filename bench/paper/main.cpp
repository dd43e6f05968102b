// The evaluation of the ASDF paper as one command: its tables, plots and pictures as a page in a folder, each number
// beside the paper's where there is one, and beside what a function of many rays says.
#include <fmt/format.h>

#include <vector>

#include "bench_program.h"
#include "cli/choice_names.h"
#include "cli/report_text.h"
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
  CLI::App app(
      "Tables, plots and pictures of the ASDF paper as a page (DIR/index.html) with CSV, SVG and PNG files.\n"
      "The first mesh takes the place of the paper's horse.",
      "asdfvk-bench-paper");
  app.add_option("meshes", arguments.meshes, "Meshes; a generated animal, hand and figure without any")
      ->option_text("MESH...");
  app.add_option("-o,--output", arguments.output, "The folder to write to; made where there is none")
      ->option_text("DIR")
      ->required();
  app.add_option("--seed-sets", arguments.evaluation.seedSetCount, "Random seeds over which medians are taken")
      ->check(CLI::Range(1u, 1000u))
      ->capture_default_str();
  app.add_option("--truth-rays", arguments.evaluation.truthRayCount, "Rays per face of what is called the truth")
      ->check(CLI::Range(1u, kMaxRayCount))
      ->capture_default_str();
  app.add_option("--faces", arguments.generatedFaceCount, "Of each generated shape")
      ->check(CLI::Range(kMinFaceCount, kMaxFaceCount))
      ->capture_default_str();
  std::vector<std::string> backendNames;
  for (const auto& [name, backend] : kBackends) backendNames.emplace_back(name);
  std::string backend = "auto";
  app.add_option("--backend", backend, "Where to compute; default auto")
      ->check(CLI::IsMember(backendNames))
      ->option_text(joined(kBackends));
  app.add_option("--device", arguments.session.device, "As asdf-vk takes it");
  for (int i = 0; i < argc; ++i)
    arguments.commandLine +=
        (i == 0 ? "" : " ") + (i == 0 ? std::string("asdfvk-bench-paper") : quotedForShell(argv[i]));
  return runBenchProgram(app, argc, argv, [&](const RunControl& control) {
    for (const auto& [name, choice] : kBackends)
      if (name == backend) arguments.session.backend = choice;
    run(arguments, control);
  });
}
