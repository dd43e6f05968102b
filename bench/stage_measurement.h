#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "file_run.h"
#include "pipeline/asdf.h"
#include "spread.h"

namespace asdfvk::bench {

struct StageRequest {
  std::vector<std::string> seeds;     ///< As parseSeedCount() reads them.
  std::vector<std::string> backends;  ///< As sessionOptionsOf() reads them.
  std::string device;
  uint32_t runCount = 5;
};

/// One run in a process of its own, so that its memory is nobody else's and nothing is compiled yet.
struct ColdRun {
  double seconds = 0;  ///< Opening the device included, loading the program not.
  double peakBytes = 0;
};

/// Seeds and backend, and their runs in order of time: run i of every row was made in the same round.
struct StageRow {
  std::string seeds, backend;
  bool perCore = false;  ///< The CPU's cores do the work.
  std::vector<FileRun> runs;
  ColdRun cold;

  [[nodiscard]] Spread stage(double StageSeconds::*member) const;
  [[nodiscard]] Spread total() const;
  [[nodiscard]] Spread raysPerSecond() const;
};

struct StageMeasurement {
  std::string mesh;
  std::vector<StageRow> rows;

  /// Null when that row was not asked for.
  [[nodiscard]] const StageRow* find(const std::string& seeds, const std::string& backend) const;
};

enum class Share { TraceAndInterpolation, Total };

/// The reference's time over Vulkan's at the same seeds, round by round; none unless `row` is Vulkan's.
[[nodiscard]] std::optional<Spread> referenceOverVulkan(const StageMeasurement& measurement, const StageRow& row,
                                                        Share share);

/// Choice of seeds, trace and interpolation over the trace of all faces by the same backend, round by round; none
/// without such a row.
[[nodiscard]] std::optional<Spread> overFullTrace(const StageMeasurement& measurement, const StageRow& row);

/// Keeps the devices open from mesh to mesh.
class StageBench {
 public:
  explicit StageBench(StageRequest request);

  /// Each round runs every row once, backends turn by turn; a first round that warms up is not counted.
  [[nodiscard]] StageMeasurement measure(const std::string& name, const std::filesystem::path& mesh,
                                         const RunControl& control);
  [[nodiscard]] const std::map<std::string, std::unique_ptr<Session>>& sessions() const { return sessions_; }

 private:
  StageRequest request_;
  std::map<std::string, std::unique_ptr<Session>> sessions_;  ///< By backend.
};

/// What the process of a ColdRun prints; `seeds` and `backend` as in a StageRow.
[[nodiscard]] std::string coldRunText(const std::string& mesh, const std::string& seeds, const std::string& backend,
                                      const std::string& device, const RunControl& control);

}  // namespace asdfvk::bench
