// The options of the measured quantity.
#include <fmt/core.h>

#include <algorithm>

#include "asdf_vk/error.h"
#include "cli/option_parsing.h"

namespace asdfvk {
namespace {

const std::vector<std::string> kFields{"thickness", "least_thickness"};
const std::vector<std::string> kDiameterFields{"sdf", "seed", "error"};

double parseThickness(const std::string& text) {
  return parseNumber(
      text, [](double x) { return x > 0; }, "is not a thickness above 0");
}

/// A limit implies the measure.
void applyLimit(const ArgumentParser& parser, CommandLine& line) {
  Options& options = line.computation.options;
  std::optional<double>& limit = options.thickness.thinnerThan;
  if (limit && line.computation.failIfThinner && *limit != *line.computation.failIfThinner)
    refuseOptions("--thinner-than and --fail-if-thinner have different limits; give one of them");
  if (line.computation.failIfThinner) limit = line.computation.failIfThinner;
  if (!limit) {
    if (options.thickness.allowsSharpEdges)
      refuseOptions("--allow-sharp-edges needs --thinner-than or --fail-if-thinner");
    return;
  }
  if (!parser.isGiven("--measure")) options.measure = Measure::Thickness;
  if (!options.measuresThickness())
    refuseOptions("--thinner-than and --fail-if-thinner contradict --measure sdf; drop one");
}

bool showsDiameter(const Outputs& outputs, bool choosesPicture) {
  const auto isOfDiameter = [](const std::string& name) { return std::ranges::count(kDiameterFields, name) > 0; };
  return std::ranges::any_of(outputs.fields, isOfDiameter) || (choosesPicture && isOfDiameter(outputs.pictureOf));
}

}  // namespace

void addMeasure(ArgumentParser& parser, CommandLine& line) {
  Options& options = line.computation.options;
  const char* const group = "Thickness";
  addChoice(parser, "--measure", options.measure, kMeasures,
            "thickness: the fields thickness, the diameter of the largest ball inside that\n"
            "touches the face, and least_thickness instead of sdf and seed; both: these\n"
            "four. Default sdf")
      .group(group);
  addValue(parser, "--thinner-than", "T",
           "Whether any point of the surface is thinner than T, in the unit of the mesh, and\n"
           "where; implies --measure thickness",
           [&options](const std::string& text) { options.thickness.thinnerThan = parseThickness(text); })
      .group(group);
  addValue(parser, "--fail-if-thinner", "T",
           "The same, and exit code 6 where a point is thinner than T, 5 where parts of the\n"
           "surface cannot be judged",
           [&line](const std::string& text) { line.computation.failIfThinner = parseThickness(text); })
      .group(group);
  parser
      .addFlag("--allow-sharp-edges", options.thickness.allowsSharpEdges,
               "With these limits: leave sharp edges and tips, where the thickness is 0, out of the\n"
               "verdict; they are listed")
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
  applyLimit(parser, line);
  Options& options = line.computation.options;
  if (options.measuresThickness()) {
    const bool choosesPicture = parser.isGiven("--picture-of");
    if (showsDiameter(line.outputs, choosesPicture)) options.measure = Measure::Both;
    if (!choosesPicture) line.outputs.pictureOf = options.thickness.thinnerThan ? "" : kFields.front();
    return;
  }
  if (parser.isGiven("--wall-angle")) refuseOptions("--wall-angle needs --measure thickness");
  for (const std::string& field : kFields) refuseField(line, field, "--measure thickness");
}

}  // namespace asdfvk
