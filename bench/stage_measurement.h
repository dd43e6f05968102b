#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asdf_vk/session.h"
#include "support/computation.h"
#include "support/measurement.h"

namespace asdfvk::bench {

struct StageRequest {
  std::vector<std::string> seeds;     ///< As parseSeedCount() reads them.
  std::vector<std::string> backends;  ///< As sessionOptionsOf() reads them.
  std::string device;
  uint32_t runCount = 5;
};

/// One run in a process of its own, so that its peak memory is that of one backend and no kernel is compiled before.
struct ColdRun {
  double seconds = 0;  ///< With opening the device, without loading the program.
  double peakBytes = 0;
};

/// The runs of one backend with one choice of seeds. The runs i of all rows were made in the same round.
struct StageRow {
  std::string seeds, backend;
  bool runsOnCpu = false;
  std::vector<FileRun> runs = {};
  ColdRun cold = {};

  [[nodiscard]] Dispersion seconds(Stage stage) const;
  [[nodiscard]] Dispersion total() const;
  [[nodiscard]] Dispersion raysPerSecond() const;
};

enum class TimeSpan {
  Interpolation,  ///< The stages sample, trace, predict and solve.
  Total,          ///< From file to file.
};

struct StageMeasurement {
  std::string mesh;
  std::vector<StageRow> rows = {};

  /// Time of the reference over the time of `row`, by round. None unless `row` is a row of Vulkan, and without a row of
  /// the reference with the same seeds.
  [[nodiscard]] std::optional<Dispersion> referenceOverVulkan(const StageRow& row, TimeSpan span) const;

  /// Time of all faces over that of `row` by the same backend, from file to file, by round: CPU seconds on a CPU,
  /// seconds elsewhere. None without a row of all faces.
  [[nodiscard]] std::optional<Dispersion> speedUp(const StageRow& row) const;

  /// TimeSpan::Interpolation over the time of the trace of all faces by the same backend, by round. None without a row
  /// of all faces.
  [[nodiscard]] std::optional<Dispersion> overFullTrace(const StageRow& row) const;

 private:
  [[nodiscard]] const StageRow* find(const std::string& seeds, const std::string& backend) const;
};

/// Keeps the devices open from mesh to mesh.
class StageBench {
 public:
  /// Throws Error{Usage} for a malformed request.
  explicit StageBench(StageRequest request);

  /// Each round runs every row once; a first round for warm-up is not counted.
  [[nodiscard]] StageMeasurement measure(const std::string& name, const std::filesystem::path& mesh,
                                         const RunControl& control);

 private:
  StageRequest request_;
  std::map<std::string, std::unique_ptr<Session>> sessions_;  ///< By backend.
};

/// Runs in this process and returns the numbers of a ColdRun as text, which the parent process reads.
[[nodiscard]] std::string coldRunText(const std::string& mesh, const std::string& seeds, const std::string& backend,
                                      const std::string& device, const RunControl& control);

}  // namespace asdfvk::bench
