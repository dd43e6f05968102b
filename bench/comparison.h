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
  uint32_t cgalRunCount = 3;  ///< At most one per round. CGAL is about a hundred times slower.
};

/// One entry per round. Entry i of every task is from the same round.
using Seconds = std::vector<double>;

inline const std::string kEmbreeFast = "Embree, fast", kEmbreeRobust = "Embree, robust";

struct SeedComparison {
  std::string seeds;
  uint64_t rayCount = 0;
  std::map<std::string, Seconds> trace = {};  ///< By tracer; all trace the same rays.
  /// By backend and task: a recipe in memory, without an error estimate; or the program from file to file.
  std::map<std::pair<std::string, std::string>, Seconds> total = {};

  /// Time of kEmbreeFast divided by that of the tracer. Unset without Embree.
  [[nodiscard]] std::optional<Dispersion> speedOverEmbree(const std::string& tracer) const;
};

struct Comparison {
  std::string mesh;
  uint64_t faceCount = 0;
  uint32_t roundCount = 0;
  std::map<std::string, std::string> devices = {};  ///< By backend.
  std::vector<SeedComparison> seeds = {};
  /// The rounds are divided into as many equal parts as CGAL has runs. Each run takes place in the first round of its
  /// part. Empty without CGAL, or if CGAL rejects the mesh.
  Seconds cgal = {};

  /// CGAL's time divided by the given time in the same part of the rounds. Unset without CGAL.
  [[nodiscard]] std::optional<Dispersion> cgalOver(const Seconds& seconds) const;
};

/// Runs all tasks in turns, after one round for warm-up.
[[nodiscard]] Comparison compare(const std::string& path, const ComparisonRequest& request, const RunControl& control);

}  // namespace asdfvk::bench
