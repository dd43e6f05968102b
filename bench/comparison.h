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
  std::vector<std::string> seeds{"all", "10%"};  ///< As parseSeedCount() reads them.
  std::string device;
  uint32_t roundCount = 5;
  uint32_t cgalRunCount = 3;  ///< At most one per round. CGAL takes about a hundred times as long.
};

/// One entry per round; the entries i of all tasks were measured in the same round.
using Seconds = std::vector<double>;

inline const std::string kEmbreeFast = "Embree, fast", kEmbreeRobust = "Embree, robust";

/// Times with one choice of seeds.
struct SeedComparison {
  std::string seeds;
  uint64_t rayCount = 0;
  std::map<std::string, Seconds> trace = {};  ///< By tracer; all trace the same rays.
  /// By backend and task: a computation in memory by a recipe, without an error estimate, or a process from file to
  /// file.
  std::map<std::pair<std::string, std::string>, Seconds> total = {};

  /// Time of kEmbreeFast over that of the tracer. None without Embree.
  [[nodiscard]] std::optional<Dispersion> speedOverEmbree(const std::string& tracer) const;
};

struct Comparison {
  std::string mesh;
  uint64_t faceCount = 0;
  uint32_t roundCount = 0;
  std::map<std::string, std::string> devices = {};  ///< By backend.
  std::vector<SeedComparison> seeds = {};
  /// The rounds are divided into as many equal parts as CGAL has runs; each run takes place in the first round of its
  /// part. Empty without CGAL and for a mesh that CGAL rejects.
  Seconds cgal = {};

  /// CGAL's time over the given time in the same part of the rounds. None without CGAL.
  [[nodiscard]] std::optional<Dispersion> cgalOver(const Seconds& seconds) const;
};

/// Runs all tasks in turns, after one round for warm-up.
[[nodiscard]] Comparison compare(const std::string& path, const ComparisonRequest& request, const RunControl& control);

}  // namespace asdfvk::bench
