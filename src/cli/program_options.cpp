// The options of outputs, batches and devices. src/describe has the other options.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "asdf_vk/error.h"
#include "cli/options.h"
#include "core/text.h"
#include "describe/option_values.h"

namespace asdfvk {
namespace {

constexpr const char* kPictureGroup = "Picture";
constexpr const char* kBatchGroup = "Many meshes";
constexpr double kMaxSeconds = 1e9, kMaxJobCount = 1024;

[[noreturn]] void reject(const std::string& message) { throw Error(ErrorCode::OptionOutOfRange, message); }

/// The text of a value. Precondition: the value comes from the command line.
const std::string& textOf(const OptionValue& value) { return std::get<std::string>(value); }

void requireFieldName(const std::string& name) {
  const std::vector<std::string> known = resultFieldNames();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Error(ErrorCode::UnknownName,
                fmt::format("'{}' is not a field; the fields are {}", name, joined(known, ", ")));
}

/// Reads names such as "sdf,seed,error".
bool readFields(void* target, const OptionValue& value) {
  const std::string& text = textOf(value);
  std::vector<std::string> names = splitAt(text, ',');
  if (names.empty() || text.ends_with(',')) return false;
  for (const std::string& name : names) {
    if (name.empty()) return false;
    if (std::count(names.begin(), names.end(), name) > 1) reject(fmt::format("'{}' names {} twice", text, name));
    requireFieldName(name);
  }
  static_cast<Outputs*>(target)->fields = std::move(names);
  return true;
}

/// Reads azimuth and elevation in degrees, such as "30,18".
bool readView(void* target, const OptionValue& value) {
  const std::string& text = textOf(value);
  const size_t comma = std::min(text.find(','), text.size());
  const auto azimuth = numberIn<double>(text.substr(0, comma)),
             elevation = numberIn<double>(text.substr(std::min(comma + 1, text.size())));
  if (!azimuth || !elevation) return false;
  if (!(std::abs(*azimuth) <= 360)) reject(fmt::format("the azimuth in '{}' is not from -360 to 360", text));
  if (!(std::abs(*elevation) <= 90)) reject(fmt::format("the elevation in '{}' is not from -90 to 90", text));
  auto& outputs = *static_cast<Outputs*>(target);
  outputs.pictureView.azimuthDegrees = *azimuth;
  outputs.pictureView.elevationDegrees = *elevation;
  outputs.choosesView = true;
  return true;
}

bool readPictureOf(void* target, const OptionValue& value) {
  const std::string name = textOf(value) == "seeds" ? "seed" : textOf(value);  // Version 0.1 had the name "seeds".
  requireFieldName(name);
  if (name == "centre") reject("'centre' has three components; a picture shows a field of one component");
  static_cast<Outputs*>(target)->pictureOf = name;
  return true;
}

/// Whether the name has the extension, or is "-".
bool hasExtension(const std::string& name, const char* extension) {
  return name == "-" || lowerCase(std::filesystem::path(name).extension().string()) == extension;
}

std::vector<std::string> pictureFields() {
  std::vector<std::string> names = resultFieldNames();
  std::erase(names, "centre");
  return names;
}

bool readMemory(void* target, const OptionValue& value) {
  const std::optional<uint64_t> bytes = parseByteCount(textOf(value));
  if (bytes) static_cast<BatchOptions*>(target)->memoryBytes = *bytes;
  return bytes.has_value();
}

OptionValue nameOrNone(const std::string& name) { return name.empty() ? OptionValue() : OptionValue(name); }

template <std::string Outputs::*kMember>
bool readName(void* target, const OptionValue& value) {
  static_cast<Outputs*>(target)->*kMember = textOf(value);
  return !textOf(value).empty();
}

const std::string kFieldsText =
    "Fields to write: " + joined(resultFieldNames(), ", ") + ". A page has all fields of one component by default";

const std::array kOutputRows{
    OptionRow{.name = "output",
              .group = kOutputGroup,
              .text = "Result: a file, a directory, or - for standard output. FILE.html is a page that shows the "
                      "results of all meshes in a browser",
              .more = "[page.md](page.md) and [formats.md](formats.md) describe the formats.",
              .placeholder = "FILE|DIR|-",
              .defaultText = "NAME.asdf.ply beside the input; none with --fail-if-thinner",
              .flags = "-o,--output",
              .wanted = "a name",
              .read = readName<&Outputs::path>,
              .write = [](const void* t) { return nameOrNone(static_cast<const Outputs*>(t)->path); }},
    OptionRow{.name = "fields",
              .text = kFieldsText.c_str(),
              .more = "The first real field is the `quality` of `.ply`. `.npy` has the first field only "
                      "([formats.md](formats.md)).",
              .placeholder = "NAME,...",
              .defaultText = "sdf,seed, and the fields of --measure, --postprocess and --segment",
              .moreNames = resultFieldNames,
              .wanted = "a list of names such as sdf,seed,error",
              .read = readFields,
              .write = [](const void* t) { return nameOrNone(joined(static_cast<const Outputs*>(t)->fields, ",")); }},
    OptionRow{.name = "open",
              .access = ASDFVK_MEMBER(Outputs, opensPage),
              .text = "Open the page in the browser. Without -o the page is NAME.asdf.html"},
    OptionRow{.name = "json",
              .access = ASDFVK_MEMBER(Outputs, json),
              .text = "Report as JSON on standard output, one line per mesh"},
    OptionRow{.name = "format",
              .access = ASDFVK_MEMBER(Outputs, format),
              .text = "Format of the result if the name of -o does not determine the format",
              .defaultText = "ply",
              .moreNames = outputFormats},
    OptionRow{.name = "ascii", .access = ASDFVK_MEMBER(Outputs, ascii), .text = "Write PLY as text"},
    OptionRow{.name = "colour-of",
              .text = "Field that determines the colours in .ply, .glb and .obj",
              .more = "The field must be written and have one component.",
              .defaultText = "segment with --segment, else the first real field",
              .moreNames = pictureFields,
              .read =
                  [](void* t, const OptionValue& value) {
                    requireFieldName(textOf(value));
                    static_cast<Outputs*>(t)->colourOf = textOf(value);
                    return true;
                  },
              .write = [](const void* t) { return nameOrNone(static_cast<const Outputs*>(t)->colourOf); }},
    OptionRow{.name = "vertex-colours",
              .access = ASDFVK_MEMBER(Outputs, coloursVertices),
              .text = "Also colour the vertices of PLY; Blender shows vertex colours",
              .more = "`.glb` and `.obj` always have vertex colours."},
    OptionRow{.name = "points",
              .text = "Also write a skeleton point for each face, half of the shape diameter below the face. PLY: "
                      "points with radius and segment. SWC: points with radius, joined into trees. - is PLY on "
                      "standard output. For one mesh only",
              .placeholder = "FILE.ply|FILE.swc",
              .wanted = "a file that ends in .ply or .swc",
              .read =
                  [](void* t, const OptionValue& value) {
                    return (hasExtension(textOf(value), ".ply") || hasExtension(textOf(value), ".swc")) &&
                           readName<&Outputs::points>(t, value);
                  },
              .write = [](const void* t) { return nameOrNone(static_cast<const Outputs*>(t)->points); }},
    OptionRow{.name = "quiet", .access = ASDFVK_MEMBER(Outputs, quiet), .text = "Print errors only"},
    OptionRow{.name = "verbose",
              .access = ASDFVK_MEMBER(Outputs, verbose),
              .text = "Print the full report: device, seeds, times, solver, places. Implies --next-wall"},
    OptionRow{.name = "picture",
              .group = kPictureGroup,
              .text = "Also render the coloured mesh; - is standard output. For one mesh only",
              .more = "The picture has 1200 x 900 pixels and a colour bar from the 1st to the 99th percentile.",
              .placeholder = "FILE.png",
              .wanted = "a file that ends in .png",
              .read =
                  [](void* t, const OptionValue& value) {
                    return hasExtension(textOf(value), ".png") && readName<&Outputs::picture>(t, value);
                  },
              .write = [](const void* t) { return nameOrNone(static_cast<const Outputs*>(t)->picture); }},
    OptionRow{.name = "picture-of",
              .text = "Field that the picture shows",
              .needs = "picture",
              .defaultText =
                  "sdf, segment with --segment, thickness with --measure thickness, or the places thinner than "
                  "a limit",
              .moreNames = pictureFields,
              .read = readPictureOf,
              .write = noValue},
    OptionRow{.name = "picture-view",
              .text = "Direction of the view: azimuth in degrees to the right of the broad side of the mesh (-360 to "
                      "360), and elevation (-90 to 90)",
              .placeholder = "AZIMUTH,ELEVATION",
              .needs = "picture",
              .defaultText = "30,18 (for thin places the view that shows them best)",
              .wanted = "two numbers with a comma between them",
              .read = readView,
              .write = noValue},
    OptionRow{.name = "picture-up",
              .access = ASDFVK_CHOICE(Outputs, pictureView.up, kUps),
              .text = "Up axis of the picture. auto: z for STL and 3MF; for other formats y, or another axis if only "
                      "on that axis the mesh stands stably",
              .needs = "picture"},
};

const std::array kBatchRows{
    OptionRow{.name = "recursive",
              .group = kBatchGroup,
              .access = ASDFVK_MEMBER(BatchOptions, recurses),
              .text = "Compute every mesh below the given folders. The results have the same subfolders below -o",
              .flags = "-r,--recursive"},
    OptionRow{.name = "files-from",
              .access = ASDFVK_MEMBER(BatchOptions, list),
              .text = "Also compute the meshes of a list with a path per line; - is standard input",
              .placeholder = "FILE|-"},
    OptionRow{.name = "null",
              .access = ASDFVK_MEMBER(BatchOptions, isNullSeparated),
              .text = "Paths of the list end with a zero byte, as find -print0 writes them",
              .needs = "files-from",
              .flags = "-0,--null"},
    OptionRow{.name = "shard",
              .text = "Compute part I of N only; the parts have about the same size",
              .placeholder = "I/N",
              .read =
                  [](void* t, const OptionValue& value) {
                    static_cast<BatchOptions*>(t)->shard = parseShard(textOf(value));
                    return true;
                  },
              .write = noValue},
    OptionRow{.name = "log",
              .access = ASDFVK_MEMBER(BatchOptions, log),
              .text = "Append a record per mesh as JSON; asdf-vk summarize FILE.jsonl reads the records",
              .placeholder = "FILE.jsonl"},
    OptionRow{.name = "skip-existing",
              .access = ASDFVK_MEMBER(BatchOptions, skipsExisting),
              .text = "Skip meshes that already have a result of the same input, options and version"},
    OptionRow{.name = "timeout",
              .access = ASDFVK_MEMBER(BatchOptions, timeoutSeconds),
              .range = aboveUpTo(0, kMaxSeconds),
              .text = "Fail a mesh that takes longer than this, with exit code 8. Without --isolate the limit applies "
                      "between steps only",
              .placeholder = "SECONDS",
              .defaultText = "-"},
    OptionRow{
        .name = "memory-limit",
        .text = "Fail a mesh that takes more memory than this, such as 500M or 2G, with exit code 8; implies --isolate",
        .placeholder = "SIZE",
        .wanted = "a size such as 500M or 2G",
        .read = readMemory,
        .write = noValue},
    OptionRow{.name = "isolate",
              .access = ASDFVK_MEMBER(BatchOptions, isolates),
              .text = "Compute in worker processes: if a mesh crashes or hangs, only this mesh fails"},
    OptionRow{.name = "jobs",
              .access = ASDFVK_MEMBER(BatchOptions, jobCount),
              .range = fromTo(1, kMaxJobCount),
              .text = "Number of meshes that are computed at once",
              .placeholder = "N",
              .defaultText = "the number of cores for many small meshes, else 1"},
};

const std::array kDeviceRows{
    OptionRow{.name = "list-devices",
              .group = kDeviceGroup,
              .access = ASDFVK_MEMBER(CommandLine, listDevices),
              .text = "List Vulkan devices and whether each is usable",
              .more = "Only `--json`, `--quiet`, `--threads` and `--require-gpu` (exit code 3 if no GPU is usable) can "
                      "be combined with `--list-devices`."},
    OptionRow{.name = "device-report",
              .access = ASDFVK_MEMBER(CommandLine, deviceReport),
              .text = "Print a report on the device as JSON, with a self-test and the rate of each variant of the "
                      "kernels; exit code 3 if the self-test fails",
              .more = "Takes `--backend`, `--device` and `--require-gpu` ([devices.md](devices.md))."},
};

}  // namespace

OptionRows outputRows() {
  static const auto rows = withGroups(kOutputRows);
  return rows;
}

std::vector<OptionTable> optionTables(CommandLine& line) {
  static const auto batchRows = withGroups(kBatchRows);
  static const auto deviceRows = withGroups(kDeviceRows);
  return {{computationRows(), &line.computation},
          {readingRows(), &line.reading},
          {otherMeshRows(), &line.others},
          {outputRows(), &line.outputs},
          {batchRows, &line.batch},
          {sessionRows(), &line.session},
          {deviceRows, &line}};
}

std::optional<uint64_t> parseByteCount(const std::string& text) {
  constexpr std::string_view kUnits = "kmgt";
  const size_t unit = text.empty() ? std::string_view::npos : kUnits.find(lowerCase(text).back());
  const bool hasUnit = unit != std::string_view::npos;
  const auto number = numberIn<double>(std::string_view(text).substr(0, text.size() - (hasUnit ? 1 : 0)));
  if (!number) return std::nullopt;
  const double bytes = hasUnit ? std::ldexp(*number, 10 * (static_cast<int>(unit) + 1)) : *number;
  return bytes >= 1 && bytes < 0x1p63 ? std::optional(static_cast<uint64_t>(bytes)) : std::nullopt;
}

}  // namespace asdfvk
