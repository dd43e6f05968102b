#include "cli/options.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <utility>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "asdf_vk/version.h"
#include "cli/exit_code.h"
#include "cli/option_parsing.h"
#include "cli/outputs.h"
#include "core/text.h"
#include "pipeline/valid_options.h"
#include "trace/vulkan/vulkan_trace_choice.h"

namespace asdfvk {
namespace {

constexpr const char* kDescription =
    "Computes the shape diameter function of triangle meshes (how thick the shape is, seen from each face): rays\n"
    "from seed faces on a Vulkan device, interpolation for the other faces.";

/// Lines of at most 110 characters.
std::string wrapped(const std::string& text) {
  constexpr size_t kWidth = 110;
  std::string lines;
  size_t width = 0;
  std::istringstream words(text);
  for (std::string word; words >> word; width += word.size() + 1) {
    if (width + word.size() > kWidth) width = 0;
    if (!lines.empty()) lines += width == 0 ? '\n' : ' ';
    lines += word;
  }
  return lines;
}

std::string footer() {
  std::string codes;
  for (const auto& [code, meaning] : kExitCodes)
    codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", static_cast<int>(code), meaning);
  return wrapped(fmt::format("Exit codes: {}. {}", codes, kExitCodeOfSeveralMeshes));
}

bool isCheckCount(const std::string& text) {
  return text == "all" || (!text.empty() && text.find_first_not_of("0123456789") == std::string::npos);
}

/// The value of --check must be attached with an equals sign, so that `--check mesh.ply` does not take the mesh as its
/// value. A number after a space is an error unless a file has that name.
void expandBareCheck(std::vector<std::string>& arguments) {
  for (size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    if (arguments[i] != "--check") continue;
    std::error_code ignored;
    if (i + 1 < arguments.size() && isCheckCount(arguments[i + 1]) &&
        !std::filesystem::exists(arguments[i + 1], ignored))
      throw Error(ErrorCode::OptionOutOfRange,
                  fmt::format("--check takes its number with an equals sign: --check={}", arguments[i + 1]));
    arguments[i] = fmt::format("--check={}", kDefaultCheckCount);
  }
}

/// Replaces --help=all by --help; returns whether it was there.
bool takeHelpAll(std::vector<std::string>& arguments) {
  constexpr std::string_view kPrefix = "--help=";
  bool showsAll = false;
  for (std::string& argument : arguments) {
    if (argument == "--") break;
    if (!argument.starts_with(kPrefix)) continue;
    const std::string value = argument.substr(kPrefix.size());
    if (value != "all") throw Error(ErrorCode::OptionOutOfRange, fmt::format("--help: '{}' is not all", value));
    argument = "--help";
    showsAll = true;
  }
  return showsAll;
}

void requireFieldName(const std::string& name) {
  const std::vector<std::string> known = resultFieldNames();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Error(ErrorCode::UnknownName,
                fmt::format("'{}' is not a field; the fields are {}", name, joined(known, ", ")));
}

/// "sdf,seed,error"
std::vector<std::string> parseFields(const std::string& text) {
  std::vector<std::string> names;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    names.push_back(text.substr(begin, end - begin));
    if (names.back().empty())
      throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' is not a list of names such as sdf,seed,error", text));
    if (std::count(names.begin(), names.end(), names.back()) > 1)
      throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' names {} twice", text, names.back()));
    requireFieldName(names.back());
    begin = end + 1;
  }
  return names;
}

/// Throws unless the name of a file has the extension or is "-".
void requireExtension(const std::string& name, const std::string& extension) {
  if (name != "-" && lowerCase(std::filesystem::path(name).extension().string()) != extension)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' does not end in {}", name, extension));
}

void addOutput(ArgumentParser& parser, CommandLine& line) {
  addValue(parser, "-o,--output", "FILE|DIR|-",
           fmt::format("Result: a file (.{}), a directory, or - for\n"
                       "standard output; default NAME.asdf.ply beside the input. .html: a page that shows the\n"
                       "results of all meshes in a browser",
                       joined(outputFormats(), " .")),
           [&](const std::string& text) {
             if (text.empty()) throw Error(ErrorCode::OptionOutOfRange, "the name is empty");
             line.outputs.path = text;
           })
      .group(kBasicGroup);
  addValue(parser, "--fields", "NAME,...",
           fmt::format("Fields to write: {};\n"
                       "default {}, and those of --measure, --postprocess and --segment;\n"
                       "in a page all of one component",
                       joined(resultFieldNames(), ", "), joined(fieldNames({}, {}), ",")),
           [&](const std::string& text) {
             line.outputs.fields = parseFields(text);
             if (std::count(line.outputs.fields.begin(), line.outputs.fields.end(), "centre") > 0)
               line.computation.options.computesCentres = true;
           })
      .completions(joined(resultFieldNames(), "|"))
      .group(kBasicGroup);
  addValue(parser, "--check", "[=N|all]",
           fmt::format("Recompute N random traced faces, and N of all faces, with the reference\n"
                       "(default {}); exit code 5 where traced faces disagree",
                       kDefaultCheckCount),
           [&](const std::string& text) { line.computation.options.checkCount = parseCheckCount(text); })
      .group(kBasicGroup);
  addPage(parser, line);
  parser.addFlag("--json", line.outputs.json, "Report as JSON on standard output, one line per mesh")
      .group(kBasicGroup);
  const char* const group = "Output";
  addName(parser, "--format", line.outputs.format, outputFormats(), "Format where -o does not decide it; default ply")
      .group(group);
  parser.addFlag("--ascii", line.outputs.ascii, "Write PLY as text").group(group);
  addChoice(parser, "--per", line.computation.options.per, kPerElements,
            "vertex: also fields per vertex, means over its faces by area, with the names of\n"
            "those per face; .csv and .npy hold these only; default face")
      .group(group);
  addValue(parser, "--points", "FILE.ply",
           "Also write the skeleton points of the faces, half of the shape diameter below\n"
           "each, with radius and segment, for one mesh; - is standard output",
           [&](const std::string& text) {
             requireExtension(text, ".ply");
             line.outputs.points = text;
             line.computation.options.computesCentres = true;
           })
      .group(group);
  parser.addFlag("--quiet", line.outputs.quiet, "Print errors only").group(group);
  parser.addFlag("--verbose", line.outputs.verbose, "Print the full report: device, seeds, times, solver, places")
      .group(group);
}

/// "30,18"
void parseViewAngles(const std::string& text, View& view) {
  const size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("'{}' is not two numbers with a comma between them", text));
  view.azimuthDegrees = parseNumber(text.substr(0, comma));
  view.elevationDegrees = parseNumber(text.substr(comma + 1));
  if (std::abs(view.azimuthDegrees) > 360)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("the azimuth in '{}' is not from -360 to 360", text));
  if (std::abs(view.elevationDegrees) > 90)
    throw Error(ErrorCode::OptionOutOfRange, fmt::format("the elevation in '{}' is not from -90 to 90", text));
}

constexpr ChoiceNames<std::optional<Up>, 7> kUps{{{"auto", std::nullopt},
                                                  {"x", Up::X},
                                                  {"y", Up::Y},
                                                  {"z", Up::Z},
                                                  {"-x", Up::MinusX},
                                                  {"-y", Up::MinusY},
                                                  {"-z", Up::MinusZ}}};

void addPicture(ArgumentParser& parser, CommandLine& line) {
  const Argument picture =
      addValue(parser, "--picture", "FILE.png", "Also render the coloured mesh, for one mesh; - is standard output",
               [&](const std::string& text) {
                 requireExtension(text, ".png");
                 line.outputs.picture = text;
               })
          .group(kBasicGroup);
  const char* const group = "Picture";
  std::vector<std::string> shown = resultFieldNames();
  std::erase(shown, "centre");
  addValue(parser, "--picture-of", joined(shown, "|"),
           fmt::format("Field to show; default {}, thickness with --measure thickness, or the\n"
                       "places thinner than a limit",
                       line.outputs.pictureOf),
           [&](const std::string& text) {
             line.outputs.pictureOf = text == "seeds" ? "seed" : text;  // "seeds": the name in version 0.1.
             requireFieldName(line.outputs.pictureOf);
             if (line.outputs.pictureOf == "centre")
               throw Error(ErrorCode::OptionOutOfRange,
                           "'centre' has three components; a picture shows a field of one component");
           })
      .group(group)
      .needs(picture);
  const View view;
  addValue(parser, "--picture-view", "AZIMUTH,ELEVATION",
           fmt::format("View, in degrees to the right of the broad side of the mesh and up;\n"
                       "default {},{}, or the view that shows the thin places best",
                       view.azimuthDegrees, view.elevationDegrees),
           [&](const std::string& text) { parseViewAngles(text, line.outputs.pictureView); })
      .group(group)
      .needs(picture);
  addChoice(parser, "--picture-up", line.outputs.pictureView.up, kUps,
            "Up axis of the picture. auto: z of an STL file, else y, unless the mesh stands\n"
            "more stably on another axis; default auto")
      .group(group)
      .needs(picture);
}

void addDevice(ArgumentParser& parser, CommandLine& line) {
  addName(parser, "--backend", line.session.backend, withAuto(backendNames()),
          "A Vulkan device, Embree on the CPU, the double-precision reference, or the\n"
          "first of them that is available; default auto")
      .group(kBasicGroup);
  const char* const group = "Device";
  addValue(parser, "--device", "N|NAME", "Vulkan device: its number in --list-devices or a part of its name",
           [&](const std::string& text) { line.session.device = text; })
      .group(group);
  parser.addFlag("--require-gpu", line.session.requireGpu, "Fail where no GPU is usable").group(group);
  parser.addFlag("--list-devices", line.listDevices, "List Vulkan devices and whether each is usable").group(group);
  parser
      .addFlag("--device-report", line.deviceReport,
               "Print a report on the device as JSON: a self-test, the rate of each variant of the\n"
               "kernels; exit code 3 where the self-test fails")
      .group(group);
  addValue(parser, "--threads", "N", "CPU threads, 1 to 1024; default: the number of cores",
           [&](const std::string& text) { line.threadCount = static_cast<uint32_t>(parseWholeNumber(text, 1, 1024)); })
      .group(group);
  TraceVariant& variant = line.session.variant;
  addName(parser, "--kernel", variant.kernel, withAuto(namesOf(kernelNames())),
          "Vulkan: neighbouring lanes trace one ray of neighbouring seeds, the rays of\n"
          "one seed, or these as a packet; default auto, by the device")
      .group(kExperimentGroup);
  addName(parser, "--bvh", variant.bvh, withAuto(namesOf(bvhNames())),
          "Vulkan: hierarchy of eight children in quantised boxes, or of two in float32;\ndefault auto")
      .group(kExperimentGroup);
  addName(parser, "--fetch", variant.fetch, withAuto(namesOf(fetchNames())),
          "Vulkan: the hierarchy is read from texel or storage buffers; default auto")
      .group(kExperimentGroup);
}

/// Throws where options of the paper's definition are given with another one.
void requireNoPaperOption(const ArgumentParser& parser, const CommandLine& line) {
  if (line.computation.options.cone.definition == Definition::Paper) return;
  for (const char* name : {"--false-hit-angle", "--outlier-deviations", "--cone-rotation"})
    if (parser.isGiven(name))
      throw Error(ErrorCode::OptionConflict,
                  fmt::format("{} belongs to --definition paper; drop one of the two", name));
  if (line.computation.options.cone.rotation != ConeRotation::Fixed)
    throw Error(ErrorCode::OptionConflict,
                "--recipe quality rotates the cones, which belongs to --definition paper; use another recipe");
}

/// Throws where options are given that --list-devices or --device-report ignores.
void requireNoIgnoredOption(const ArgumentParser& parser, const CommandLine& line) {
  if (!line.listDevices && !line.deviceReport) return;
  const std::string name = line.listDevices ? "--list-devices" : "--device-report";
  std::set<std::string> used{name, "--quiet", "--threads", "--json", "--require-gpu"};
  if (!line.listDevices) used.insert({"--backend", "--device"});
  for (const std::string& given : parser.givenNames())
    if (!used.contains(given))
      refuseOptions(fmt::format("{} is about devices only: {} has no effect; drop one of the two", name,
                                given == "meshes" ? "a mesh" : given));
}

/// Throws where rounds of seeds cannot have an effect.
void requireRounds(const CommandLine& line) {
  const Options& options = line.computation.options;
  const bool limitsError = options.rounds.limitError();
  if (limitsError && !options.estimatesError)
    refuseOptions("--max-error needs the estimate of the error; drop it, or --no-estimate");
  if (options.rounds.areSet() && options.seeds.kind == SeedCount::Kind::All)
    refuseOptions(fmt::format("{} adds seeds, but with --seeds all every face is one; drop one of the two",
                              limitsError ? "--max-error" : "--time-budget"));
}

void validateOptions(const CommandLine& line) {
  if (line.meshes.empty() && line.batch.list.empty() && !line.listDevices && !line.deviceReport)
    refuseOptions("no mesh was given; asdf-vk --help lists the options");
  if (std::count(line.meshes.begin(), line.meshes.end(), "-") > 1)
    refuseOptions("standard input ('-') can be read only once; name it once");
  if (std::count(line.meshes.begin(), line.meshes.end(), "") > 0) refuseOptions("the name of a mesh is empty");
  if (line.outputs.path == "-" && line.outputs.json)
    refuseOptions("-o - and --json both write to standard output; give -o a file or drop --json");
  if (!line.outputs.picture.empty() && line.meshes.size() > 1)
    refuseOptions("--picture takes one mesh; name one mesh, or run them one by one");
  if (line.outputs.picture == "-" && (line.outputs.path == "-" || line.outputs.json))
    refuseOptions("--picture - writes to standard output, as do --json and -o -; give it a file, or drop them");
  if (!line.outputs.points.empty() && line.meshes.size() > 1)
    refuseOptions("--points takes one mesh; name one mesh, or run them one by one");
  if (line.outputs.points == "-" && (line.outputs.path == "-" || line.outputs.json || line.outputs.picture == "-"))
    refuseOptions(
        "--points - writes to standard output, as do --json, -o - and --picture -; give it a file, or drop them");
  const bool isCpu = line.session.backend == "cpu" || line.session.backend == "reference";
  const TraceVariant& variant = line.session.variant;
  if (isCpu && line.session.requireGpu)
    refuseOptions("--require-gpu contradicts --backend cpu and reference, which run on the CPU; drop one");
  if (isCpu && !line.session.device.empty())
    refuseOptions("--device chooses a Vulkan device, which --backend cpu and reference do not use; drop one");
  if (isCpu && !(variant.kernel.empty() && variant.bvh.empty() && variant.fetch.empty()))
    refuseOptions("--kernel, --bvh and --fetch choose shaders, which --backend cpu and reference do not use; drop one");
  const bool estimates =
      line.computation.options.estimatesError && line.computation.options.seeds.kind != SeedCount::Kind::All;
  if (line.outputs.pictureOf == "error" && !estimates)
    refuseOptions("--picture-of error needs an estimate; drop --no-estimate, and --seeds all, which has no error");
  if (std::count(line.outputs.fields.begin(), line.outputs.fields.end(), "error") > 0 && !estimates)
    refuseOptions("--fields error needs an estimate; drop --no-estimate, and --seeds all, which has no error");
  if (isCpu && solverNeedsDevice(line.computation.options.solver))
    refuseOptions(fmt::format(
        "--solver {} runs on a Vulkan device, which --backend cpu and reference do not use; use --solver cpu",
        line.computation.options.solver));
  requireRounds(line);
  if (line.computation.options.interpolation.pooling > 0 &&
      line.computation.options.interpolation.guidance != Guidance::Prediction)
    refuseOptions(
        "--pooling moves values to the prediction, which --recipe paper and --guidance none or curvature do not have; "
        "drop one of the two");
  if (line.outputs.quiet && line.outputs.verbose)
    refuseOptions("--quiet and --verbose contradict each other; drop one");
  requireValid(line.computation.options, true);
}

}  // namespace

void addOptions(ArgumentParser& parser, CommandLine& line) {
  parser.setProgram("asdf-vk", kDescription);
  parser.setFooter(footer());
  parser.setHelp("Print the most needed options; --help=all prints all");
  parser.addVersion(fmt::format("asdf-vk {} ({})", ASDFVK_VERSION, ASDFVK_COMMIT));
  parser
      .addList("meshes", "MESH...", fmt::format("Meshes: .{}; - is standard input", joined(meshFormats(), " .")),
               line.meshes)
      .completions(fmt::format("FILE.{}|-", joined(meshFormats(), "|FILE.")));
  addComputation(parser, line);
  addOutput(parser, line);
  addPicture(parser, line);
  addBatch(parser, line);
  addDevice(parser, line);
}

CommandLine parseCommandLine(std::vector<std::string> arguments) {
  CommandLine line;
  ArgumentParser parser;
  addOptions(parser, line);
  expandBareCheck(arguments);
  expandBareSegment(arguments);
  if (!takeHelpAll(arguments)) {
    parser.setHelpGroup(kBasicGroup);
    parser.setFooter("--help=all lists all options.\n" + footer());
  }
  const ParseResult result = parser.parse(std::move(arguments));
  if (!result.answer.empty()) {
    line.answer = result.answer;
    return line;
  }
  if (!result.miscounted.empty())
    throw Error(ErrorCode::OptionOutOfRange, result.miscounted + " takes exactly one value, once");
  if (!result.refusal.empty())
    throw Error(ErrorCode::OptionOutOfRange, result.refusal + "; asdf-vk --help=all lists the options");
  if (line.computation.options.rounds.areSet() && !parser.isGiven("--seeds"))
    line.computation.options.seeds = SeedCount::ofShare(kFirstRoundShare);
  TraceVariant& variant = line.session.variant;
  for (std::string* name : {&variant.kernel, &variant.bvh, &variant.fetch})
    if (*name == "auto") name->clear();
  requireNoIgnoredOption(parser, line);
  line.computation.options.keepsScene = !line.outputs.picture.empty();
  completeSegments(parser, line);
  completeMeasure(parser, line);
  completePage(parser, line);
  completeBatch(parser, line);
  requireNoPaperOption(parser, line);
  validateOptions(line);
  return line;
}

std::string shortUsage() {
  return "Usage: asdf-vk MESH... [OPTIONS]\n"
         "Computes the shape diameter function of triangle meshes; writes NAME.asdf.ply beside each.\n"
         "asdf-vk --help lists the options.\n";
}

}  // namespace asdfvk
