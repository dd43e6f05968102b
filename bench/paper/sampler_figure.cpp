#include "paper/sampler_figure.h"

#include <fmt/format.h>

#include "cli/report_text.h"
#include "cli/terminal.h"
#include "paper/paper_numbers.h"
#include "share_errors.h"
#include "spread.h"

namespace asdfvk::bench {
namespace {

constexpr const char* kCsv = "figure7.csv";

struct SamplerErrors {
  std::vector<uint8_t> isSeed;  ///< Of the first seed set.
  uint64_t seedCount = 0;
  double paper = 0, balanced = 0;  ///< Average errors over the range, medians over the seed sets.
};

Options samplerOptions(const std::string& sampler, Recipe recipe, uint64_t randomSeed) {
  Options options = recipeOptions(recipe, kSamplerPercent, randomSeed);
  options.sampler = sampler;
  options.estimatesError = false;  // Its held-out faces would be among the seeds, at random whatever the sampler.
  return options;
}

SamplerErrors measure(Session& session, Mesh& mesh, const std::string& sampler, const Evaluation& evaluation,
                      uint32_t seedSetCount, const RunControl& control) {
  SamplerErrors errors;
  std::vector<double> paper, balanced;
  for (uint32_t round = 1; round <= seedSetCount; ++round) {
    Result result = session.compute(mesh, samplerOptions(sampler, Recipe::Balanced, round), control);
    balanced.push_back(errorsOverRange(evaluation.full.sdf, result.sdf).average);
    if (round == 1) {
      errors.seedCount = result.report.seedCount;
      errors.isSeed = std::move(result.isSeed);
    }
    const Result plain = session.compute(mesh, samplerOptions(sampler, Recipe::Paper, round), control);
    paper.push_back(errorsOverRange(evaluation.full.sdf, plain.sdf).average);
  }
  errors.paper = spreadOf(paper).median;
  errors.balanced = spreadOf(balanced).median;
  return errors;
}

}  // namespace

void addSamplerFigure(Page& page, const Studio& studio, const OutputFolder& folder, Session& session, Subject& subject,
                      const Evaluation& evaluation, uint32_t seedSetCount, const RunControl& control) {
  Table table;
  table.columns = {{"", "sampler"},
                   {"", "seeds"},
                   {"average error", "interpolation of paper"},
                   {"average error", "interpolation of balanced"}};
  std::vector<PageImage> images;
  for (const std::string& name : samplerNames()) {
    writeStandardError(fmt::format("{}: sampler {}\n", subject.name, name));
    const SamplerErrors errors = measure(session, subject.mesh, name, evaluation, seedSetCount, control);
    table.rows.push_back({Cell::word(name), Cell::count(errors.seedCount), Cell::number(errors.paper, 4),
                          Cell::number(errors.balanced, 4)});
    images.push_back(studio.seeds(fmt::format("figure7-{}", name), subject, errors.isSeed,
                                  fmt::format("{}: {:.4f} | {:.4f}", name, errors.paper, errors.balanced), kPlain));
  }
  folder.write(kCsv, toCsv(table));
  page.figure(images, 6, "Figure 7",
              fmt::format("Faces selected by every sampler, {:g} % of all ({} seeds), and the average error that comes "
                          "of them, with the interpolation of recipe paper | of balanced. Random selection, the "
                          "paper\u2019s, gives no weight to the features of the mesh; "
                          "normal-space is the Gaussian sphere that it names as future work.",
                          kSamplerPercent, table.rows.front()[1].text),
              kCsv);
}

}  // namespace asdfvk::bench
