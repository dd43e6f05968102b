// The options of a page.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "cli/option_parsing.h"
#include "cli/outputs.h"

namespace asdfvk {
namespace {

/// The computation of the options in `text`.
Computation comparedComputation(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
  if (arguments.empty()) refuseOptions("there is no option of the computation, such as \"--recipe paper\"");
  const std::string mesh = "mesh";  // Stands for those of the call, which may be in a list.
  arguments.insert(arguments.begin(), mesh);
  const CommandLine other = parseCommandLine(std::move(arguments));
  const CommandLine defaults;
  const TraceVariant& variant = other.session.variant;
  const bool hasOthers =
      other.meshes != std::vector<std::string>{mesh} || other.answer || !other.outputs.path.empty() ||
      !other.outputs.format.empty() || !other.outputs.picture.empty() || !other.outputs.points.empty() ||
      other.outputs.json || other.outputs.quiet || other.outputs.verbose || other.outputs.ascii ||
      other.batch.isBatch() || other.batch.jobCount != 0 || std::isfinite(other.batch.timeoutSeconds) ||
      !other.outputs.fields.empty() || other.outputs.opensPage || other.listDevices || other.threadCount != 0 ||
      other.session.backend != defaults.session.backend || !other.session.device.empty() || other.session.requireGpu ||
      other.deviceReport || !(variant.kernel.empty() && variant.bvh.empty() && variant.fetch.empty()) || other.compared;
  if (hasOthers)
    refuseOptions("only options of the computation are allowed; give those of output and device beside it");
  Computation compared = other.computation;
  compared.against = text;
  compared.options.keepsScene = true;
  return compared;
}

}  // namespace

void addPage(ArgumentParser& parser, CommandLine& line) {
  parser.addFlag("--open", line.outputs.opensPage, "Open the page in the browser; without -o, NAME.asdf.html")
      .group(kBasicGroup);
  addValue(parser, "--against", "OPTIONS",
           "For a page: also show each mesh with these options of the computation instead of\n"
           "the given ones, in quotes: --against \"--seeds all\"",
           [&](const std::string& text) { line.compared = comparedComputation(text); })
      .group("Output");
}

void completePage(const ArgumentParser& parser, CommandLine& line) {
  line.outputs.choosesView = parser.isGiven("--picture-view");
  if (line.outputs.opensPage && line.outputs.path.empty() && line.outputs.format.empty())
    line.outputs.format = kPageFormat;
  const bool isPage = writesPages(line.outputs);
  if (line.outputs.opensPage && !isPage) refuseOptions("--open opens a page; give -o FILE.html, or drop --open");
  if (line.outputs.opensPage && line.outputs.path == "-")
    refuseOptions("--open opens a file, which -o - does not write; give -o FILE.html");
  if (line.outputs.opensPage && line.meshes.size() > 1 && !writesOnePage(line.outputs))
    refuseOptions("--open opens one page; give -o FILE.html, which shows all meshes");
  if (isPage && std::count(line.outputs.fields.begin(), line.outputs.fields.end(), "centre") > 0)
    refuseOptions("--fields centre has three components; a page shows fields of one component");
  line.computation.options.keepsScene = line.computation.options.keepsScene || isPage;
  if (!line.compared) return;
  if (!isPage) refuseOptions("--against compares in a page; give -o FILE.html");
  if (std::count(line.meshes.begin(), line.meshes.end(), "-") > 0)
    refuseOptions("--against reads each mesh twice, which standard input does not allow; give it a file");
}

}  // namespace asdfvk
