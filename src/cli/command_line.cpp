#include "cli/command_line.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "asdf_vk/error.h"
#include "asdf_vk/files.h"
#include "asdf_vk/version.h"
#include "cli/exit_code.h"
#include "cli/input_options.h"
#include "cli/program_options.h"
#include "core/text.h"
#include "describe/fields.h"
#include "describe/option_rules.h"
#include "pipeline/backend.h"
#include "serve/json_schema.h"

namespace asdfvk {
namespace {

constexpr const char* kDescription =
    "Computes the local thickness of triangle meshes: the shape diameter function or the wall thickness of each face. "
    "Seed faces cast rays on a Vulkan device or the CPU; the values of the other faces are interpolated.";

constexpr const char* kHelp = R"(asdf-vk: local thickness of triangle meshes, by rays on Vulkan or the CPU

  asdf-vk horse.ply               shape diameter of each face, in horse.asdf.ply
  asdf-vk horse.ply -o horse.html --open       a page, shown in a browser
    --fields NAME,...             fields to write: sdf, seed, error, ...
    --picture FILE.png            also a picture

Walls
  asdf-vk part.stl --thinner-than 0.8          places that are thinner than 0.8
  asdf-vk part.stl --fail-if-thinner 0.8       as above, with exit code 6
    --measure thickness           wall thickness of each face, without a limit
    --count-edges                 count thin edges and details, too

Parts
  asdf-vk horse.ply --segment                  a part number for each face
    --parts N                     number of parts; default: automatic
    --detail X                    from 0.1 (few parts) to 10 (many)

Accuracy and time
  asdf-vk horse.ply --max-error 1%             add rays until the error is 1 %
    --seeds N%|N|all              faces with rays; default 10%, at least 3,000
    --recipe paper|balanced|quality            quality: pooled rays, slower
    --check                       compare 2,000 faces with the reference

Many meshes
  asdf-vk -r parts -o results --log log.jsonl  all meshes below a folder
  asdf-vk summarize log.jsonl                  counts, times and failures
    --skip-existing               resume: skip meshes whose result is up to date
    --tar                         the inputs and results are tars of meshes
    --jobs N                      meshes at once

Input and output
  asdf-vk scan.stl --orient auto -o scan.csv   also .ply .glb .obj .npz .html
    -o FILE|DIR|-                 the result; - is standard output
    --json                        the report as JSON on standard output
    --backend auto|vulkan|cpu|reference        what traces; see --list-devices

--help=all lists all options. man asdf-vk has the exit codes.
)";

std::string footer() {
  std::string codes;
  for (const auto& [code, meaning] : kExitCodes)
    codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", static_cast<int>(code), meaning);
  return fmt::format("Exit codes: {}. {}", codes, kExitCodeOfSeveralMeshes);
}

bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// Whether an option with an optional value takes the next argument as its value. --segment takes a word that does not
/// look like a file. A word looks like a file if it has a dot or a slash, begins with a dash, or is the path of a file.
/// --check never takes the next argument, so that a mesh can follow; a number that is not a file is an error.
bool takesNext(const OptionRow& row, const std::string& next) {
  const std::vector<std::string> names = namesOf(row);
  if (std::find(names.begin(), names.end(), next) != names.end()) return true;
  if (next.starts_with('-') || next.find_first_of("./") != std::string::npos || exists(next)) return false;
  if (!names.empty()) return true;
  if (next == "all" || next.find_first_not_of("0123456789") == std::string::npos)
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("--{0} takes its number with an equals sign: --{0}={1}", row.name, next));
  return false;
}

/// Throws Error{OptionConflict} if an option is given that --list-devices or --device-report ignores.
void requireNoIgnoredOption(const std::vector<std::string>& given, const CommandLine& line) {
  if (!line.schema.empty() && given.size() > 1)
    refuseOptions("--print-schema prints the schema only; drop the other arguments");
  if (!line.listDevices && !line.deviceReport) return;
  const std::string name = line.listDevices ? "--list-devices" : "--device-report";
  std::set<std::string> used{name, "--quiet", "--threads", "--json", "--require-gpu"};
  if (!line.listDevices) used.insert({"--backend", "--device"});
  for (const std::string& option : given)
    if (!used.contains(option))
      refuseOptions(fmt::format("{} is about devices only: {} has no effect; drop one of the two", name,
                                option == "meshes" ? "a mesh" : option));
}

std::string helpText(const OptionRow& row, const OptionRows& rows) {
  std::string text = row.text;
  if (const std::string range = rangeText(row); !range.empty()) text += "; " + range;
  if (*row.needs != 0) text += "; needs " + neededText(row, rows, OptionSpelling::Flag);
  if (const std::string value = defaultText(row); value != "-" && !isFlag(row)) text += "; default " + value;
  return withSpelledOptions(rows, text, OptionSpelling::Flag);
}

bool estimates(const Options& options) {
  return options.estimatesError && options.seeds.kind != SeedCount::Kind::All && options.measuresDiameter();
}

/// Sets the options that --fields, --picture-of and --points imply, such as --measure both. Throws
/// Error{OptionConflict} for a field that the other options do not compute.
void completeFields(CommandLine& line) {
  Options& options = line.computation.options;
  const Outputs& outputs = line.outputs;
  std::vector<std::pair<const char*, std::string>> shown;
  for (const std::string& name : outputs.fields) shown.emplace_back("--fields", name);
  if (!outputs.pictureOf.empty()) shown.emplace_back("--picture-of", outputs.pictureOf);
  if (!outputs.points.empty()) options.computesCentres = true;
  for (const auto& field : shown)
    if (const auto request = fieldRow(field.second).request; request != nullptr) request(options);
  for (const auto& field : shown) {
    const FieldRow& row = fieldRow(field.second);
    const bool lacksFormer = field.second == "thickness_change" && line.others.former.empty();
    if (lacksFormer || (row.isComputed != nullptr && !row.isComputed(options)))
      refuseOptions(
          fmt::format("{} {} needs {}", field.first, row.name, withSpelledOptions(row.needs, OptionSpelling::Flag)));
    if (field.second == "error" && !estimates(options))
      refuseOptions(fmt::format("{} error needs an error estimate; drop --no-estimate and --seeds all", field.first));
  }
}

/// A run for a verdict writes a result only if an option about the result is given.
/// Files of limits are for walls, unless another measure is given.
void completeLimits(CommandLine& line, const GivenOptions& given) {
  Options& options = line.computation.options;
  if (!line.outputs.limits.empty() && !given.has("measure") && options.measure == Measure::ShapeDiameter)
    options.measure = Measure::Thickness;
}

void completeResult(CommandLine& line, const GivenOptions& given) {
  constexpr std::array kAboutResult{"format", "fields", "open", "ascii", "colour-of", "vertex-colours"};
  line.outputs.writesRecordsOnly =
      isCheck(line.computation, line.outputs) &&
      std::none_of(kAboutResult.begin(), kAboutResult.end(), [&](const char* name) { return given.has(name); });
  line.outputs.writesResult = !line.outputs.writesRecordsOnly || given.has("output") || given.has("keep-members");
  if (!line.outputs.writesResult && line.batch.skipsExisting)
    refuseOptions("--skip-existing looks for results, but --fail-if-... writes none without -o; give -o");
}

/// The chord error of a check is a share of the limit.
void completeReading(CommandLine& line) {
  constexpr double kChordErrorShare = 1.0 / 50;
  const ThicknessOptions& thickness = line.computation.options.thickness;
  const std::optional<LengthLimit>& limit = thickness.thinnerThan ? thickness.thinnerThan : thickness.closerThan;
  if (line.reading.chordError > 0 || !limit) return;
  line.reading.chordError = kChordErrorShare * limit->value;
  line.reading.chordErrorUnit = limit->unit;
}

void completePage(CommandLine& line) {
  Outputs& outputs = line.outputs;
  if (outputs.opensPage && outputs.path.empty() && outputs.format.empty()) outputs.format = kPageFormat;
  const bool isPage = writesPages(outputs);
  const bool isOnePage = isPage && (line.meshes.size() == 1 || writesOnePage(outputs));
  if (outputs.opensPage && (!isOnePage || outputs.path == "-"))
    refuseOptions("--open opens one page; give -o FILE.html for a page of all meshes, or drop --open");
  if (isPage && std::count(outputs.fields.begin(), outputs.fields.end(), "centre") > 0)
    refuseOptions("--fields centre has three components; a page shows fields of one component");
  line.computation.options.keepsScene = isPage || !outputs.picture.empty();
}

void completeBatch(CommandLine& line, const GivenOptions& given) {
  BatchOptions& batch = line.batch;
  if (batch.memoryBytes > 0) batch.isolates = true;
  const bool readsInput = std::count(line.meshes.begin(), line.meshes.end(), "-") > 0;
  if (given.has("files-from") && batch.list.empty()) refuseOptions("--files-from: the name is empty");
  if (given.has("log") && batch.log.empty()) refuseOptions("--log: the name is empty");
  if (batch.list == "-" && readsInput)
    refuseOptions("--files-from - and the mesh '-' both read standard input; name a file instead of one of the two");
  if (batch.isolates && readsInput && !batch.readsTars)
    refuseOptions(
        "--isolate and --memory-limit compute in other processes, which cannot read the mesh '-'; name a file instead "
        "of '-'");
  if (batch.skipsExisting && readsInput)
    refuseOptions("--skip-existing does not apply to the mesh '-'; name a file instead of '-'");
  if (!batch.isBatch()) {
    if (batch.jobCount > 1 && writesOnePage(line.outputs))
      refuseOptions("for one page of all meshes, one mesh is computed after another; drop --jobs");
    return;
  }
  if (line.outputs.path == "-" && !batch.readsTars)
    refuseOptions("standard output (-o -) holds one result; give -o a folder");
  if (batch.readsTars && writesPages(line.outputs))
    refuseOptions("a page is a file of its own, and no member of a tar; drop --tar, or --format html");
  if (batch.readsTars && batch.skipsExisting && line.outputs.needsRecords())
    refuseOptions(
        "the record of a skipped tar has no verdicts of its meshes; drop --skip-existing, or --report-format "
        "and --update-baseline");
  if (batch.readsTars && !line.outputs.picture.empty())
    refuseOptions("--picture draws meshes in files of their own; drop it, or --tar");
  if (!line.outputs.picture.empty() && !hasPictureFolder(line.outputs))
    refuseOptions(fmt::format("--picture {} is for one mesh; give a folder that ends in /, such as --picture pictures/",
                              line.outputs.picture));
  if (!line.outputs.points.empty())
    refuseOptions(
        "--points takes one mesh; drop it, or -r, --files-from, --log, --skip-existing, --shard and --isolate");
  if (writesOnePage(line.outputs) || line.outputs.opensPage)
    refuseOptions("a batch writes a page per mesh: give -o a folder, with --format html, and drop --open");
}

void validateOthers(const CommandLine& line) {
  const OtherMeshes& others = line.others;
  if (others.isEmpty()) return;
  if (!others.with.empty() && !others.former.empty())
    refuseOptions(
        "--with and --compare exclude each other, because the former version has no bodies beside it; drop one");
  const char* const name = others.with.empty() ? "--compare" : "--with";
  if (line.batch.isBatch() || line.meshes.size() != 1)
    refuseOptions(fmt::format("{} takes one mesh; run asdf-vk once per mesh, without a batch", name));
  const Options& options = line.computation.options;
  if (!others.with.empty() && (options.segmentation != Segmentation::None || options.postprocesses()))
    refuseOptions(
        "--with computes the faces of the first mesh only, and parts need all; drop --with, or --segment and "
        "--postprocess");
}

void validateOptions(const CommandLine& line) {
  if (line.meshes.empty() && line.batch.list.empty() && !line.listDevices && !line.deviceReport)
    refuseOptions("no mesh was given; asdf-vk --help lists the options");
  if (std::count(line.meshes.begin(), line.meshes.end(), "-") > 1)
    refuseOptions("standard input can be read only once; give - once");
  if (std::count(line.meshes.begin(), line.meshes.end(), "") > 0) refuseOptions("the name of a mesh is empty");
  if (line.outputs.path == "-" && line.outputs.json)
    refuseOptions("-o - and --json both write to standard output; give -o a file or drop --json");
  if (!line.outputs.picture.empty() && !hasPictureFolder(line.outputs) && line.meshes.size() > 1)
    refuseOptions(
        fmt::format("--picture {} is for one mesh; name one mesh, or give a folder, such as --picture pictures/",
                    line.outputs.picture));
  if (line.outputs.picture == "-" && (line.outputs.path == "-" || line.outputs.json))
    refuseOptions(
        "--picture -, --json and -o - write to standard output, which only one of them can use; give --picture a file, "
        "or drop the others");
  if (!line.outputs.points.empty() && line.meshes.size() > 1)
    refuseOptions("--points takes one mesh; name one mesh, or run asdf-vk once per mesh");
  if (line.outputs.points == "-" && (line.outputs.path == "-" || line.outputs.json || line.outputs.picture == "-"))
    refuseOptions(
        "--points -, --json, -o - and --picture - write to standard output, which only one of them can use; give "
        "--points a file, or drop the others");
  if (!line.outputs.reportFormat.empty() && line.outputs.report == "-" &&
      (line.outputs.path == "-" || line.outputs.json || line.outputs.picture == "-" || line.outputs.points == "-"))
    refuseOptions(
        "--report-format, --json, -o -, --picture - and --points - write to standard output, which only one of them "
        "can use; give --report a file, or drop the others");
  const BackendChoice backend = line.session.backend;
  const SolverChoice solver = line.computation.options.solver;
  if (!mayUseDevice(backend) && solverNeedsDevice(solver))
    refuseOptions(fmt::format(
        "--solver {} runs on a Vulkan device, which --backend cpu and reference do not use; use --solver cpu",
        nameOf(kSolverNames, solver)));
  if (line.outputs.quiet && line.outputs.verbose)
    refuseOptions("--quiet and --verbose contradict each other; drop one");
}

OptionRows deviceRows(CommandLine& line) {
  return withGroups({
      OptionRow{.name = "list-devices",
                .group = kDeviceGroup,
                .member = &line.listDevices,
                .text = "List Vulkan devices and whether each is usable",
                .more =
                    "Only `{json}`, `{quiet}`, `{threads}` and `{require-gpu}` (exit code 3 if no GPU is usable) can "
                    "be combined with `{list-devices}`."},
      OptionRow{.name = "device-report",
                .member = &line.deviceReport,
                .text = "Print a report on the device as JSON, with a self-test and the rate of each variant of the "
                        "kernels; exit code 3 if the self-test fails",
                .more = "Takes `{backend}`, `{device}` and `{require-gpu}` ([devices.md](devices.md))."},
      OptionRow{.name = "print-schema",
                .group = kOutputGroup,
                .member = &line.schema,
                .text = "Print the JSON Schema of a document; report: what {json} prints",
                .more = "[formats.md](formats.md#json-schema) has a table of the documents.",
                .names = schemaNames,
                .bareValue = kSchemaDocuments.front().name},
  });
}

}  // namespace

void addArguments(const OptionRows& rows, std::vector<Argument>& arguments) {
  for (const OptionRow& row : rows) {
    const std::string flag = spelled(row, OptionSpelling::Flag);
    if (flag.empty()) continue;
    Argument argument{.names = row.flags != nullptr ? row.flags : flag,
                      .placeholder = isFlag(row) ? "" : placeholderOf(row),
                      .text = helpText(row, rows),
                      .receive = {},
                      .group = row.group,
                      .isRepeatable = row.isRepeatable};
    if (isFlag(row))
      argument.receive = [row, value = !flag.starts_with("--no-")](const Argument::Values&) {
        setOption(row, value, "", OptionSpelling::Flag);
      };
    else
      argument.receive = [row](const Argument::Values& values) {
        setOptionText(row, values.empty() ? row.bareValue : values.front());
      };
    if (row.bareValue != nullptr) argument.takesNext = [row](const std::string& next) { return takesNext(row, next); };
    arguments.push_back(std::move(argument));
  }
}

std::vector<OptionRows> optionTables(CommandLine& line) {
  return {computationRows(line.computation),
          readingRows(line.reading),
          otherMeshRows(line.others),
          outputRows(line.outputs),
          batchRows(line.batch),
          sessionRows(line.session),
          deviceRows(line)};
}

ArgumentParser parserOf(CommandLine& line) {
  std::vector<Argument> arguments{{.names = "meshes",
                                   .placeholder = "MESH...",
                                   .text = fmt::format("Meshes: .{}; - is standard input", joined(meshFormats(), " .")),
                                   .receive = [&line](const Argument::Values& values) { line.meshes = values; },
                                   .isList = true}};
  for (const OptionRows& rows : optionTables(line)) addArguments(rows, arguments);
  ArgumentParser parser("asdf-vk", kDescription, fmt::format("asdf-vk {} ({})", ASDFVK_VERSION, ASDFVK_COMMIT),
                        std::move(arguments));
  parser.shortHelp = kHelp;
  parser.footer = footer();
  parser.removedText = [](std::string_view name) { return removedOptionText(name, OptionSpelling::Flag); };
  return parser;
}

void completeLine(CommandLine& line, const GivenOptions& given) {
  line.computation.compares = !line.others.former.empty();
  complete(line.computation, given);
  requireValid(line.session, given.spelling);
  for (const OptionRows& rows : optionTables(line)) requireNeeds(rows, given);
  if (Options& options = line.computation.options;
      line.outputs.verbose && (options.measuresThickness() || options.measuresGap()))
    options.thickness.findsNextWall = true;
  completeLimits(line, given);
  completeFields(line);
  completeReading(line);
  completeResult(line, given);
  completePage(line);
  completeBatch(line, given);
  validateOptions(line);
  validateOthers(line);
}

CommandLine parseCommandLine(const std::vector<std::string>& arguments) {
  CommandLine line;
  ArgumentParser parser = parserOf(line);
  if (std::string answer = parser.parse(arguments); !answer.empty()) {
    line.answer = std::move(answer);
    return line;
  }
  requireNoIgnoredOption(parser.givenNames(), line);
  if (!line.schema.empty()) {
    line.answer = documentSchema(line.schema);
    return line;
  }
  GivenOptions given{.names = {}, .spelling = OptionSpelling::Flag};
  for (const OptionRows& rows : optionTables(line))
    for (const OptionRow& row : rows)
      if (const std::string flag = spelled(row, OptionSpelling::Flag); !flag.empty() && parser.isGiven(flag))
        given.names.insert(row.name);
  completeLine(line, given);
  return line;
}

void refuseOptions(const std::string& message) { throw Error(ErrorCode::OptionConflict, message); }

std::string shortUsage() {
  return "Usage: asdf-vk MESH... [OPTIONS]\n"
         "Computes the local thickness (shape diameter function) of triangle meshes.\n"
         "Writes NAME.asdf.ply beside each mesh.\n"
         "asdf-vk --help has examples and the options.\n";
}

}  // namespace asdfvk
