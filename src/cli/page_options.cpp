// The options of a page.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "cli/option_parsing.h"
#include "cli/output_plan.h"

namespace asdfvk {
namespace {

/// A copy of `line` with the options of the computation from `text` instead of its own.
CommandLine comparedLine(const CommandLine& line, const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
  if (arguments.empty()) refuseOptions("--against names no option of the computation, such as \"--recipe paper\"");
  const std::string mesh = "mesh";  // Stands for those of `line`, which may be in a list.
  arguments.insert(arguments.begin(), mesh);
  CommandLine other;
  try {
    other = parseCommandLine(std::move(arguments));
  } catch (const Error& error) {
    throw Error(error.code(), std::string("--against: ") + error.what());
  }
  const CommandLine defaults;
  const TraceVariant& variant = other.session.variant;
  const bool hasOthers =
      other.meshes != std::vector<std::string>{mesh} || other.answer || !other.output.empty() ||
      !other.format.empty() || !other.picture.empty() || !other.points.empty() || other.json || other.quiet ||
      other.ascii || other.batch.isBatch() || other.batch.jobCount != 0 || std::isfinite(other.batch.timeoutSeconds) ||
      other.choosesFields || other.opensPage || other.listDevices || other.threadCount != 0 ||
      other.session.backend != defaults.session.backend || !other.session.device.empty() || other.session.requireGpu ||
      other.deviceReport || !(variant.kernel.empty() && variant.bvh.empty() && variant.fetch.empty()) ||
      !other.compared.empty();
  if (hasOthers)
    refuseOptions("--against takes options of the computation only; give those of output and device beside it");
  CommandLine compared = line;
  compared.options = other.options;
  compared.recipe = other.recipe;
  compared.failIfThinner = other.failIfThinner;
  compared.valueOptions = other.valueOptions;
  if (!line.choosesFields) compared.fields = other.fields;
  compared.against = text;
  compared.picture.clear();  // They show the given options.
  compared.points.clear();
  return compared;
}

}  // namespace

void addPage(ArgumentParser& parser, CommandLine& line) {
  parser.addFlag("--open", line.opensPage, "Open the page in the browser; without -o, NAME.asdf.html")
      .group(kBasicGroup);
  addValue(parser, "--against", "OPTIONS",
           "For a page: also show each mesh with these options of the computation instead of\n"
           "the given ones, in quotes: --against \"--seeds all\"",
           [&](const std::string& text) { line.against = text; })
      .group("Output");
}

void completePage(const ArgumentParser& parser, CommandLine& line) {
  line.choosesFields = parser.isGiven("--fields");
  line.choosesView = parser.isGiven("--picture-view");
  if (line.opensPage && line.output.empty() && line.format.empty()) line.format = kPageFormat;
  const bool isPage = writesPages(line);
  if (line.opensPage && !isPage) refuseOptions("--open opens a page; give -o FILE.html, or drop --open");
  if (line.opensPage && line.output == "-")
    refuseOptions("--open opens a file, which -o - does not write; give -o FILE.html");
  if (line.opensPage && line.meshes.size() > 1 && !writesOnePage(line))
    refuseOptions("--open opens one page; give -o FILE.html, which shows all meshes");
  if (isPage && line.choosesFields && std::count(line.fields.begin(), line.fields.end(), "centre") > 0)
    refuseOptions("--fields centre has three components; a page shows fields of one component");
  line.options.keepsScene = line.options.keepsScene || isPage;
  if (!parser.isGiven("--against")) return;
  if (!isPage) refuseOptions("--against compares in a page; give -o FILE.html");
  if (std::count(line.meshes.begin(), line.meshes.end(), "-") > 0)
    refuseOptions("--against reads each mesh twice, which standard input does not allow; give it a file");
  line.compared = {comparedLine(line, std::exchange(line.against, ""))};
  line.compared.front().options.keepsScene = true;
}

}  // namespace asdfvk
