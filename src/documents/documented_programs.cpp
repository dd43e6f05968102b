// What the man pages have beyond the options.
#include "asdf_vk/version.h"
#include "cli/exit_code.h"
#include "cli/options.h"
#include "cli/summarize.h"
#include "documents/program.h"
#include "generate/generator_options.h"

namespace asdfvk {
namespace {

/// Options, version and summary of a program, or of a command, whose options are parsed into an `Options`.
template <typename Options>
Program programWith(const char* summary) {
  Options options;
  ArgumentParser parser;
  addOptions(parser, options);
  Program program = describe(parser);
  program.version = ASDFVK_VERSION;
  program.summary = summary;
  return program;
}

Program documentedAsdfVk() {
  Program program = programWith<CommandLine>("compute the shape diameter function of triangle meshes");
  for (const auto& [code, meaning] : kExitCodes) program.exitCodes.emplace_back(static_cast<int>(code), meaning);
  program.exitNote = kExitCodeOfSeveralMeshes;
  program.files = {{"NAME.asdf.ply",
                    "The result for the mesh NAME.ply (or .off, .obj, .stl), beside it, unless -o is given: the mesh, "
                    "the fields of its faces, and their colours."},
                   {"NAME.asdf.ply.json", "In a batch, the record of the result, by which --skip-existing finds it."}};
  program.environment = {
      {"ASDF_VK_VALIDATION", "1 enables the Vulkan validation layers; anything that they report is an error."},
      {"VK_DRIVER_FILES",
       "The driver manifests that the Vulkan loader uses instead of the installed ones, separated by colons."}};
  program.examples = {
      {"Write the values of the faces to mesh.asdf.ply:", "asdf-vk mesh.ply"},
      {"Choose the number of seeds by the error, and check the values with the reference:",
       "asdf-vk mesh.ply --max-error 1% --check"},
      {"Find the parts of a shape, and draw them:",
       "asdf-vk mesh.ply --segment --picture parts.png --picture-of segment"},
      {"Show the result in a browser:", "asdf-vk mesh.ply --open"},
      {"Fail where a part is thinner than 0.8, in the unit of the mesh:", "asdf-vk part.stl --fail-if-thinner 0.8"},
      {"Compute all meshes below a folder, resume where the call was interrupted, and summarise the log:",
       "asdf-vk -r meshes -o results --log log.jsonl --skip-existing; asdf-vk summarize log.jsonl"},
      {"Read from standard input, write comma-separated values to standard output:",
       "asdf-vk-generate animal -o - | asdf-vk - -o - --format csv"}};
  program.seeAlso = {"asdf-vk-summarize(1)", "asdf-vk-generate(1)", "vulkaninfo(1)"};
  return program;
}

Program documentedGenerator() {
  Program program = programWith<GeneratorOptions>("generate triangle meshes of known shape diameter or wall thickness");
  program.exitCodes.assign(kGeneratorExitCodes.begin(), kGeneratorExitCodes.end());
  program.examples = {
      {"An animal of about 20,000 faces:", "asdf-vk-generate animal -o animal.ply"},
      {"A sphere of radius 10:", "asdf-vk-generate sphere --scale 10 -o sphere.ply"},
      {"A wedge of 12 faces that is 0.3 thick at one end:", "asdf-vk-generate thin-wedge -o wedge.ply"}};
  program.seeAlso = {"asdf-vk(1)"};
  return program;
}

}  // namespace

std::vector<Program> documentedPrograms() { return {documentedAsdfVk(), documentedGenerator()}; }

Program documentedSummarize() {
  Program program = programWith<SummaryOptions>("summarise the logs of batches of asdf-vk");
  for (const ExitCode code : {ExitCode::Done, ExitCode::Usage, ExitCode::Input, ExitCode::Output, ExitCode::Internal})
    program.exitCodes.emplace_back(static_cast<int>(code), meaningOf(code));
  program.examples = {{"A table:", "asdf-vk summarize log.jsonl"},
                      {"A row per mesh, of all parts of a batch:", "asdf-vk summarize part*.jsonl -o batch.csv"}};
  program.seeAlso = {"asdf-vk(1)"};
  return program;
}

}  // namespace asdfvk
