// The options of post-processing and segmentation, and what they imply.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "asdf_vk/error.h"
#include "cli/option_parsing.h"

namespace asdfvk {
namespace {

constexpr const char* kSegmentGroup = "Segments";

bool isSegmentation(const std::string& text) {
  return std::any_of(kSegmentations.begin(), kSegmentations.end(),
                     [&](const auto& choice) { return choice.first == text; });
}

bool looksLikeFile(const std::string& text) {
  std::error_code ignored;
  return text == "-" || text.find_first_of("./") != std::string::npos || std::filesystem::exists(text, ignored);
}

void addParts(ArgumentParser& parser, PartsOptions& options) {
  addValue(parser, "--parts", "N",
           fmt::format("--segment parts: the number of parts, 1 to {}; default: it is found", kMaxPartCount),
           [&](const std::string& text) {
             options.partCount = static_cast<uint32_t>(parseWholeNumber(text, 1, kMaxPartCount));
           })
      .group(kSegmentGroup);
  addValue(parser, "--detail", "X",
           fmt::format("--segment parts: divides the cost at which merging stops, {} to {}; a larger\n"
                       "number gives more parts; default {}",
                       kMinDetail, kMaxDetail, PartsOptions{}.detail),
           [&](const std::string& text) {
             options.detail = parseNumber(
                 text, [](double x) { return x >= kMinDetail && x <= kMaxDetail; },
                 fmt::format("is not from {} to {}", kMinDetail, kMaxDetail).c_str());
           })
      .group(kSegmentGroup);
}

void addCgal(ArgumentParser& parser, CgalSegmentationOptions& options) {
  const CgalSegmentationOptions defaults;
  addValue(parser, "--clusters", "K",
           fmt::format("--segment cgal: clusters of values, 2 to {}; not the number of segments;\n"
                       "default {}",
                       kMaxClusterCount, defaults.clusterCount),
           [&](const std::string& text) {
             options.clusterCount = static_cast<uint32_t>(parseWholeNumber(text, 2, kMaxClusterCount));
           })
      .group(kSegmentGroup);
  addValue(parser, "--smoothness", "L",
           fmt::format("--segment cgal: weight of the boundaries, 0 to {}, usually at most 1;\n"
                       "default {}",
                       kMaxSmoothness, defaults.smoothness),
           [&](const std::string& text) {
             options.smoothness = parseNumber(
                 text, [](double x) { return x >= 0 && x <= kMaxSmoothness; },
                 fmt::format("is not from 0 to {}", kMaxSmoothness).c_str());
           })
      .group(kSegmentGroup);
  addChoice(parser, "--cgal-expansion", options.expansion, kCgalExpansions,
            "--segment cgal: the graph cut expands all clusters, or the first one only, as\n"
            "CGAL 5.5.1 does; default all")
      .group(kSegmentGroup);
}

}  // namespace

void addSegments(ArgumentParser& parser, Options& options) {
  addChoice(parser, "--postprocess", options.postprocess, kPostprocesses,
            "Field normalized. cgal: missing values are filled, all are smoothed and mapped\n"
            "to 0 .. 1, as CGAL does; default none")
      .group(kSegmentGroup);
  addChoice(parser, "--segment", options.segmentation, kSegmentations,
            "Field segment. parts: the parts that people see, also --segment without a\n"
            "value. cgal: soft clustering and graph cut, as CGAL does; implies\n"
            "--postprocess cgal; for --seeds all. Default none")
      .group(kSegmentGroup);
  addParts(parser, options.parts);
  addCgal(parser, options.cgalSegmentation);
}

void expandBareSegment(std::vector<std::string>& arguments) {
  for (size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    if (arguments[i] != "--segment") continue;
    if (i + 1 < arguments.size() && isSegmentation(arguments[i + 1])) continue;
    if (i + 1 == arguments.size() || arguments[i + 1].starts_with("-") || looksLikeFile(arguments[i + 1]))
      arguments[i] = fmt::format("--segment={}", nameOf(kSegmentations, Segmentation::Parts));
  }
}

void completeSegments(const ArgumentParser& parser, CommandLine& line) {
  Options& options = line.computation.options;
  if (options.segmentation != Segmentation::Cgal)
    for (const char* option : {"--clusters", "--smoothness", "--cgal-expansion"})
      if (parser.isGiven(option)) refuseOptions(fmt::format("{} needs --segment cgal", option));
  if (options.segmentation != Segmentation::Parts)
    for (const char* option : {"--parts", "--detail"})
      if (parser.isGiven(option)) refuseOptions(fmt::format("{} needs --segment parts", option));
  if (parser.isGiven("--parts") && parser.isGiven("--detail"))
    refuseOptions("--parts and --detail contradict each other; drop one");
  if (options.segmentation == Segmentation::Cgal && parser.isGiven("--postprocess") &&
      options.postprocess == Postprocess::None)
    refuseOptions("--segment cgal contradicts --postprocess none; drop one");
  if (parser.isGiven("--postprocess") && options.postprocess != Postprocess::None)
    line.computation.valueOptions = "--postprocess";
  if (parser.isGiven("--segment") && options.segmentation != Segmentation::None)
    line.computation.valueOptions += line.computation.valueOptions.empty() ? "--segment" : " and --segment";
  if (options.postprocesses()) options.postprocess = Postprocess::Cgal;
  const auto require = [&](const char* field, bool isComputed, const char* remedy) {
    if (!isComputed) refuseField(line, field, remedy);
  };
  require("normalized", options.postprocesses(), "--postprocess cgal");
  require("segment", options.segmentation != Segmentation::None, "--segment");
}

}  // namespace asdfvk
