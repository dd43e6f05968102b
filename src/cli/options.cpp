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
#include "cli/outputs.h"
#include "core/text.h"
#include "describe/fields.h"
#include "pipeline/valid_options.h"

namespace asdfvk {
namespace {

constexpr const char* kDescription =
    "Computes the shape diameter function of triangle meshes (how thick the shape is, seen from each face): rays\n"
    "from seed faces on a Vulkan device, interpolation for the other faces.";

constexpr size_t kHelpWidth = 80, kFooterWidth = 110;

std::string wrapped(const std::string& text, size_t lineWidth) {
  std::string lines;
  size_t width = 0;
  std::istringstream words(text);
  for (std::string word; words >> word; width += word.size() + 1) {
    if (width + word.size() > lineWidth) width = 0;
    if (!lines.empty()) lines += width == 0 ? '\n' : ' ';
    lines += word;
  }
  return lines;
}

std::string footer() {
  std::string codes;
  for (const auto& [code, meaning] : kExitCodes)
    codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", static_cast<int>(code), meaning);
  return wrapped(fmt::format("Exit codes: {}. {}", codes, kExitCodeOfSeveralMeshes), kFooterWidth);
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

/// --segment without a value, at the end or before an option or a file, becomes --segment=parts. A file is a name that
/// has a dot or a slash, is "-", or exists; the names of kSegmentations are values, also where such a file exists.
void expandBareSegment(std::vector<std::string>& arguments) {
  const auto looksLikeFile = [](const std::string& text) {
    std::error_code ignored;
    return text == "-" || text.find_first_of("./") != std::string::npos || std::filesystem::exists(text, ignored);
  };
  for (size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    if (arguments[i] != "--segment") continue;
    const bool isLast = i + 1 == arguments.size();
    if (!isLast && findChoice(kSegmentations, arguments[i + 1]) != nullptr) continue;
    if (isLast || arguments[i + 1].starts_with("-") || looksLikeFile(arguments[i + 1])) arguments[i] += "=parts";
  }
}

/// Throws where options are given that --list-devices or --device-report ignores.
void requireNoIgnoredOption(const std::vector<std::string>& given, const CommandLine& line) {
  if (!line.listDevices && !line.deviceReport) return;
  const std::string name = line.listDevices ? "--list-devices" : "--device-report";
  std::set<std::string> used{name, "--quiet", "--threads", "--json", "--require-gpu"};
  if (!line.listDevices) used.insert({"--backend", "--device"});
  for (const std::string& option : given)
    if (!used.contains(option))
      refuseOptions(fmt::format("{} is about devices only: {} has no effect; drop one of the two", name,
                                option == "meshes" ? "a mesh" : option));
}

bool estimates(const Options& options) {
  return options.estimatesError && options.seeds.kind != SeedCount::Kind::All && options.measuresDiameter();
}

/// Fields of the diameter are measured where they are requested; other fields need their options.
void completeFields(CommandLine& line, bool choosesPicture) {
  Options& options = line.computation.options;
  Outputs& outputs = line.outputs;
  std::vector<std::pair<const char*, std::string>> shown;
  for (const std::string& name : outputs.fields) shown.emplace_back("--fields", name);
  if (choosesPicture) shown.emplace_back("--picture-of", outputs.pictureOf);
  const auto shows = [&](std::string_view name) {
    return std::any_of(shown.begin(), shown.end(), [&](const auto& field) { return field.second == name; });
  };
  if (shows("centre") || !outputs.points.empty()) options.computesCentres = true;
  if (options.measuresThickness()) {
    if (shows("sdf") || shows("seed") || shows("error")) options.measure = Measure::Both;
    if (!choosesPicture) outputs.pictureOf = options.thickness.thinnerThan ? "" : "thickness";
  }
  for (const auto& field : shown) {
    const char* option = field.first;
    const std::string& name = field.second;
    const auto row =
        std::find_if(fieldRows().begin(), fieldRows().end(), [&](const auto& r) { return r.name == name; });
    const bool isComputed = name == "normalized"          ? options.postprocesses()
                            : name == "segment"           ? options.segmentation != Segmentation::None
                            : name.ends_with("thickness") ? options.measuresThickness()
                                                          : true;
    if (!isComputed) refuseOptions(fmt::format("{} {} needs --{}", option, name, row->needs));
    if (name == "error" && !estimates(options))
      refuseOptions(
          fmt::format("{} error needs an estimate; drop --no-estimate, and --seeds all, which has no error", option));
  }
}

void completePage(CommandLine& line) {
  Outputs& outputs = line.outputs;
  if (outputs.opensPage && outputs.path.empty() && outputs.format.empty()) outputs.format = kPageFormat;
  const bool isPage = writesPages(outputs);
  if (outputs.opensPage && !isPage) refuseOptions("--open opens a page; give -o FILE.html, or drop --open");
  if (outputs.opensPage && outputs.path == "-")
    refuseOptions("--open opens a file, which -o - does not write; give -o FILE.html");
  if (outputs.opensPage && line.meshes.size() > 1 && !writesOnePage(outputs))
    refuseOptions("--open opens one page; give -o FILE.html, which shows all meshes");
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
    refuseOptions("--files-from - and the mesh - both read standard input; give one of them a file");
  if (batch.isolates && readsInput)
    refuseOptions(
        "--isolate and --memory-limit compute in other processes, which cannot read the mesh -; give it a file");
  if (batch.skipsExisting && readsInput) refuseOptions("--skip-existing does not apply to the mesh -; give it a file");
  if (!batch.isBatch()) {
    if (batch.jobCount > 1 && writesOnePage(line.outputs))
      refuseOptions("one page takes one mesh after another; drop --jobs");
    return;
  }
  if (line.outputs.path == "-") refuseOptions("-o - takes the result of one mesh; give -o a folder");
  if (!line.outputs.picture.empty() || !line.outputs.points.empty())
    refuseOptions(
        "--picture and --points take one mesh; drop them, or -r, --files-from, --log, --skip-existing, --shard and "
        "--isolate");
  if (writesOnePage(line.outputs) || line.outputs.opensPage)
    refuseOptions("a batch writes a page per mesh: give -o a folder, with --format html, and drop --open");
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
  const std::string& backend = line.session.backend;
  if ((backend == "cpu" || backend == "reference") && solverNeedsDevice(line.computation.options.solver))
    refuseOptions(fmt::format(
        "--solver {} runs on a Vulkan device, which --backend cpu and reference do not use; use --solver cpu",
        line.computation.options.solver));
  if (line.outputs.quiet && line.outputs.verbose)
    refuseOptions("--quiet and --verbose contradict each other; drop one");
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
  for (const OptionTable& table : optionTables(line)) addRows(parser, table);
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
  requireNoIgnoredOption(parser.givenNames(), line);
  GivenOptions given{.names = {}, .spelling = OptionSpelling::Flag};
  for (const OptionTable& table : optionTables(line))
    for (const OptionRow& row : table.rows)
      if (const std::string flag = spelled(row, OptionSpelling::Flag); !flag.empty() && parser.isGiven(flag))
        given.names.insert(row.name);
  complete(line.computation, given);
  requireValid(line.session, given.spelling);
  for (const OptionTable& table : optionTables(line)) requireNeeds(table.rows, table.target, given);
  completeFields(line, given.has("picture-of"));
  completePage(line);
  completeBatch(line, given);
  validateOptions(line);
  return line;
}

void refuseOptions(const std::string& message) { throw Error(ErrorCode::OptionConflict, message); }

std::string helpText(const OptionRow& row, const OptionTable& table) {
  std::string text = row.text;
  if (const std::string range = rangeText(row); !range.empty()) text += "; " + range;
  if (*row.needs != 0) text += "; needs " + neededText(row, table.rows, OptionSpelling::Flag);
  if (isFlag(row)) return text;
  const std::string value = defaultText(row, table.target);
  return value == "-" ? text : text + "; default " + value;
}

void addRows(ArgumentParser& parser, const OptionTable& table) {
  for (const OptionRow& row : table.rows) {
    const std::string flag = spelled(row, OptionSpelling::Flag);
    if (flag.empty()) continue;
    const std::string names = row.flags != nullptr ? row.flags : flag, text = wrapped(helpText(row, table), kHelpWidth);
    void* const target = table.target;
    const auto setFlag = [&row, target, value = !flag.starts_with("--no-")] {
      setOption(row, target, value, "", OptionSpelling::Flag);
    };
    const auto setValue = [&row, target](const std::string& value) { setOptionText(row, target, value); };
    const Argument argument =
        isFlag(row) ? parser.addFlag(names, setFlag, text) : parser.addValue(names, placeholderOf(row), text, setValue);
    (void)argument.group(row.isBasic ? kBasicGroup : row.group);
    if (const std::vector<std::string> all = namesOf(row); *row.placeholder != 0 && !all.empty())
      (void)argument.completions(joined(all, "|"));
  }
}

std::string shortUsage() {
  return "Usage: asdf-vk MESH... [OPTIONS]\n"
         "Computes the shape diameter function of triangle meshes; writes NAME.asdf.ply beside each.\n"
         "asdf-vk --help lists the options.\n";
}

}  // namespace asdfvk
