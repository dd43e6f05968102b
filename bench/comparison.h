#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/run_control.h"
#include "support/measurement.h"

namespace asdfvk::bench {

struct ComparisonRequest {
  std::vector<std::string> seeds{"all", "10%"};  ///< In the syntax of parseSeedCount().
  std::string device;
  uint32_t roundCount = 5;
  /// Number of runs of CGAL, at most one per round. CGAL is about a hundred times slower than asdf-vk.
  uint32_t cgalRunCount = 3;
};

/// One entry per round: entry i of every task is from round i.
using Seconds = std::vector<double>;

struct SeedComparison {
  std::string seeds;
  uint64_t rayCount = 0;
  std::map<std::string, Seconds> trace = {};  ///< One element per tracer. All tracers trace the same rays.
  /// One element per backend and task. A task is a recipe in memory, without an error estimate, or a run of the program
  /// from file to file.
  std::map<std::pair<std::string, std::string>, Seconds> total = {};

  /// Time of kEmbreeFast divided by the time of the tracer. Unset without Embree.
  [[nodiscard]] std::optional<Dispersion> speedOverEmbree(const std::string& tracer) const;
};

struct Comparison {
  std::string mesh;
  uint64_t faceCount = 0;
  uint32_t roundCount = 0;
  std::map<std::string, std::string> devices = {};  ///< One element per backend.
  std::vector<SeedComparison> seeds = {};
  /// Times of CGAL. The rounds are divided into equal parts, one part per run of CGAL. A run takes place in the first
  /// round of its part. Empty without CGAL, or if CGAL rejects the mesh.
  Seconds cgal = {};

  /// Time of CGAL divided by the given time; both are from the same part of the rounds. Unset without CGAL.
  [[nodiscard]] std::optional<Dispersion> cgalOver(const Seconds& seconds) const;
};

/// Runs all tasks in turns, after one round for warm-up.
[[nodiscard]] Comparison compare(const std::string& path, const ComparisonRequest& request, const RunControl& control);

}  // namespace asdfvk::bench
