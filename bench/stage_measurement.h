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
#include "support/process.h"

namespace asdfvk::bench {

struct StageRequest {
  std::vector<std::string> seeds;     ///< In the syntax of parseSeedCount().
  std::vector<std::string> backends;  ///< Names of backends for sessionOptionsOf().
  std::string device;
  uint32_t runCount = 5;
};

/// The runs of one backend with one choice of seeds. Run i of every row is from round i.
struct StageRow {
  std::string seeds, backend;
  bool runsOnCpu = false;
  std::vector<FileRun> runs = {};
  /// Time of the process asdf-vk, including opening the device, reading and writing.
  std::vector<ProcessUsage> processes = {};

  [[nodiscard]] Dispersion seconds(Stage stage) const;
  [[nodiscard]] Dispersion share(Stage stage) const;  ///< Time of the stage / total time.
  [[nodiscard]] Dispersion total() const;
  [[nodiscard]] Dispersion raysPerSecond() const;
  [[nodiscard]] Dispersion process(double ProcessUsage::*quantity) const;
};

enum class TimeSpan {
  Interpolation,  ///< The stages sample, trace, predict and solve.
  Total,          ///< The whole computation, including reading and writing.
};

struct StageMeasurement {
  std::string mesh;
  std::vector<StageRow> rows = {};

  /// Time of the backend reference divided by the time of `row`, per round. Unset for other backends, and without runs
  /// of the backend reference.
  [[nodiscard]] std::optional<Dispersion> referenceOverVulkan(const StageRow& row, TimeSpan span) const;

  /// Process time with all faces as seeds, divided by the process time of `row` on the same backend, per round. CPU
  /// seconds on a CPU, elapsed seconds on other devices. Unset without a row for all faces.
  [[nodiscard]] std::optional<Dispersion> speedUp(const StageRow& row) const;

  /// TimeSpan::Interpolation divided by the time to trace all faces on the same backend. Unset without a row for all
  /// faces.
  [[nodiscard]] std::optional<Dispersion> overFullTrace(const StageRow& row) const;

 private:
  [[nodiscard]] const StageRow* find(const std::string& seeds, const std::string& backend) const;
};

class StageBench {
 public:
  /// Throws Error{Usage} for an invalid request.
  explicit StageBench(StageRequest request);

  /// Each round runs every row once. The first round is a warm-up and is not counted.
  [[nodiscard]] StageMeasurement measure(const std::string& name, const std::filesystem::path& mesh,
                                         const RunControl& control);

 private:
  StageRequest request_;
  std::map<std::string, std::unique_ptr<Session>> sessions_;  ///< One element per backend.
};

}  // namespace asdfvk::bench
