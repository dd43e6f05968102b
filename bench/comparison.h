#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/run_control.h"
#include "mesh/mesh.h"
#include "pipeline/asdf.h"
#include "spread.h"

namespace asdfvk::bench {

struct ComparisonRequest {
  std::vector<std::string> seeds{"all", "10%"};  ///< As parseSeedCount() reads them.
  std::string device;
  uint32_t roundCount = 5;
  uint32_t cgalRunCount = 3;  ///< It takes a hundred times as long. At most one in each round.
};

/// Seconds, one entry per round; entry i of everything was measured in the same round.
using Seconds = std::vector<double>;

/// b over a, round by round.
[[nodiscard]] Spread ratioOf(const Seconds& b, const Seconds& a);

inline const std::string kBareEmbree = "bare Embree", kRobustEmbree = "bare, robust";

/// Of one choice of seeds.
struct SeedComparison {
  std::string seeds;
  uint64_t rayCount = 0;
  std::map<std::string, Seconds> trace;  ///< By backend and kernel, and of Embree alone; the same rays.
  /// By backend and what of it: a computation by a recipe in memory, without the estimate of the error, or a process
  /// as people start it, from file to file.
  std::map<std::pair<std::string, std::string>, Seconds> whole;
};

struct Comparison {
  std::string mesh;
  uint64_t faceCount = 0;
  uint32_t roundCount = 0;
  std::map<std::string, std::string> devices;  ///< By backend.
  std::vector<SeedComparison> seeds;
  /// The rounds fall into as many parts as CGAL has runs, and it runs in the first of each. Empty without CGAL, and for
  /// a mesh that it refuses.
  Seconds cgal;
};

/// CGAL's time over ours in the same part of the rounds, round by round; ours: one entry per round. None without CGAL.
[[nodiscard]] std::optional<Spread> cgalOver(const Comparison& comparison, const Seconds& ours);

/// Everything turn by turn, after a round that is not counted.
[[nodiscard]] Comparison compare(const std::string& path, const ComparisonRequest& request, const RunControl& control);

}  // namespace asdfvk::bench
