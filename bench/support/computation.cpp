#include "support/computation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>

#include "asdf_vk/files.h"
#include "core/check.h"
#include "core/median.h"
#include "core/stopwatch.h"

namespace asdfvk::bench {

SessionOptions sessionOptionsOf(const std::string& backend, const std::string& device) {
  const BackendChoice choice = choiceNamed(kBackendNames, backend);
  const bool usesDevice = choice == BackendChoice::Vulkan || choice == BackendChoice::Automatic;
  return {.backend = choice, .device = usesDevice ? device : ""};
}

SeedCount parseSeedCount(const std::string& text) {
  const auto parse = [&text](std::string_view digits, auto max) {
    decltype(max) number{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size() || !(number > 0 && number <= max))
      throw Error(ErrorCode::OptionOutOfRange,
                  fmt::format("'{}' is not a number of seeds; allowed: a share such as 10% (above 0, "
                              "at most 100), a count of at least 1, or all",
                              text));
    return number;
  };
  if (text == "all") return SeedCount::all();
  if (!text.ends_with('%')) return SeedCount::ofCount(parse(text, std::numeric_limits<uint64_t>::max()));
  return SeedCount::ofShare(parse(std::string_view(text).substr(0, text.size() - 1), 100.0) / 100);
}

Options recipeOptions(Recipe recipe, double percent, uint64_t randomSeed) {
  Options options;
  applyRecipe(recipe, options);
  options.seeds = percent == 100 ? SeedCount::all() : SeedCount::ofShare(percent / 100);
  options.randomSeed = randomSeed;
  return options;
}

Options truthOptions(uint32_t rayCount) {
  Options options = recipeOptions(Recipe::Paper, 100);
  options.cone.rayCount = rayCount;
  options.cone.rotation = ConeRotation::Hashed;
  return options;
}

FileRun runFile(Session& session, const std::filesystem::path& path, const Options& options,
                const std::filesystem::path& output, const RunControl& control) {
  const Stopwatch total;
  const Mesh mesh = readMesh(path);
  const double readSeconds = total.seconds();
  Result result = session.compute(mesh, options, control);
  const Stopwatch writing;
  writeResult(output, mesh, result.fields, {.format = {}, .fields = {"sdf", "seed"}});
  result.report.stageSeconds[Stage::Write] = writing.seconds();
  result.report.stageSeconds[Stage::Read] = readSeconds;
  return {std::move(result.report), total.seconds()};
}

FieldErrors errorsOverRange(std::span<const double> full, std::span<const double> approximate) {
  ASDFVK_CHECK_OP(full.size(), ==, approximate.size());
  double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0;
  size_t count = 0;
  FieldErrors errors;
  std::vector<double> present, relative;
  for (size_t i = 0; i < full.size(); ++i) {
    if (std::isnan(full[i])) continue;
    low = std::min(low, full[i]);
    high = std::max(high, full[i]);
    present.push_back(full[i]);
    if (std::isnan(approximate[i])) continue;
    const double error = std::abs(approximate[i] - full[i]);
    sum += error;
    relative.push_back(error == 0 ? 0 : error / std::abs(full[i]));
    errors.maximum = std::max(errors.maximum, error);
    ++count;
  }
  if (!(high > low) || count == 0) return {};
  errors.average = sum / static_cast<double>(count) / (high - low);
  errors.maximum /= high - low;
  const double low1 = percentileOf(present, 0.01), high99 = percentileOf(present, 0.99);
  errors.robustAverage = sum / static_cast<double>(count) / (high99 - low1);
  errors.relativeMedian = percentileOf(relative, 0.5);
  errors.relativePercentile90 = percentileOf(relative, 0.9);
  return errors;
}

}  // namespace asdfvk::bench
