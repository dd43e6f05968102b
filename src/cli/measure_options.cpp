// The options of the measured quantity.
#include <fmt/core.h>

#include <algorithm>

#include "asdf_vk/error.h"
#include "cli/option_parsing.h"

namespace asdfvk {
namespace {

constexpr const char* kField = "thickness";

double parseThickness(const std::string& text) {
  return parseNumber(
      text, [](double x) { return x > 0; }, "is not a thickness above 0");
}

/// The limits imply the measure; all faces cast rays unless the number of seeds is given.
void applyLimits(const ArgumentParser& parser, CommandLine& line) {
  Options& options = line.options;
  std::optional<double>& limit = options.thickness.thinnerThan;
  if (line.failIfThinner) {
    if (limit && *limit < *line.failIfThinner)
      refuseOptions(
          "--fail-if-thinner is above --thinner-than, whose regions are reported; raise --thinner-than, or drop it");
    if (!limit) limit = line.failIfThinner;
  }
  if (!limit) return;
  if (parser.isGiven("--measure") && options.measure != Measure::Thickness)
    refuseOptions("--thinner-than and --fail-if-thinner contradict --measure sdf; drop one");
  options.measure = Measure::Thickness;
  if (!parser.isGiven("--seeds") && !options.rounds.areSet()) options.seeds = SeedCount::all();
}

}  // namespace

void addMeasure(ArgumentParser& parser, CommandLine& line) {
  Options& options = line.options;
  const char* const group = "Thickness";
  addChoice(parser, "--measure", options.measure, kMeasures,
            "thickness: also field thickness, the diameter of the largest ball inside that\n"
            "touches the face; it is written first. Default sdf")
      .group(group);
  addValue(parser, "--thinner-than", "T",
           "List the connected regions thinner than T, in the unit of the mesh; implies\n"
           "--measure thickness, and --seeds all unless given",
           [&options](const std::string& text) { options.thickness.thinnerThan = parseThickness(text); })
      .group(group);
  addValue(parser, "--fail-if-thinner", "T", "The same, and exit code 6 where a face is thinner than T",
           [&line](const std::string& text) { line.failIfThinner = parseThickness(text); })
      .group(group);
  addValue(parser, "--wall-angle", "DEGREES",
           fmt::format("--measure thickness: a wall is opposing if its normal differs by this from that\n"
                       "of the face, above 90 and at most 180; default {}",
                       options.thickness.wallAngleDegrees),
           [&options](const std::string& text) {
             options.thickness.wallAngleDegrees = parseNumber(
                 text, [](double x) { return x > 90 && x <= 180; }, "is not above 90 and at most 180");
           })
      .group(group);
}

void completeMeasure(const ArgumentParser& parser, CommandLine& line) {
  applyLimits(parser, line);
  if (line.options.measure == Measure::Thickness) {
    if (!parser.isGiven("--fields")) line.fields.insert(line.fields.begin(), kField);
    if (!parser.isGiven("--picture-of")) line.pictureOf = kField;
    return;
  }
  if (parser.isGiven("--wall-angle")) refuseOptions("--wall-angle needs --measure thickness");
  refuseField(line, kField, "--measure thickness");
}

}  // namespace asdfvk
