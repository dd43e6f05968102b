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
  std::vector<std::string> backends;  ///< Names for sessionOptionsOf().
  std::string device;
  uint32_t runCount = 5;
};

/// The runs of one backend with one choice of seeds. Run i of every row was made in the same round.
struct StageRow {
  std::string seeds, backend;
  bool runsOnCpu = false;
  std::vector<FileRun> runs = {};
  std::vector<ProcessUsage> processes = {};  ///< asdf-vk from file to file, including opening the device.

  [[nodiscard]] Dispersion seconds(Stage stage) const;
  [[nodiscard]] Dispersion share(Stage stage) const;  ///< Share of the total.
  [[nodiscard]] Dispersion total() const;
  [[nodiscard]] Dispersion raysPerSecond() const;
  [[nodiscard]] Dispersion process(double ProcessUsage::*quantity) const;
};

enum class TimeSpan {
  Interpolation,  ///< The stages sample, trace, predict and solve.
  Total,          ///< From file to file.
};

struct StageMeasurement {
  std::string mesh;
  std::vector<StageRow> rows = {};

  /// Time of the reference divided by that of `row`, by round. Unset for other backends and without a reference.
  [[nodiscard]] std::optional<Dispersion> referenceOverVulkan(const StageRow& row, TimeSpan span) const;

  /// Time of the process of all faces divided by that of `row` by the same backend, by round: CPU seconds on a CPU,
  /// elapsed seconds on other devices. Unset without a row of all faces.
  [[nodiscard]] std::optional<Dispersion> speedUp(const StageRow& row) const;

  /// TimeSpan::Interpolation divided by the trace time of all faces by that backend. Unset without a row of all faces.
  [[nodiscard]] std::optional<Dispersion> overFullTrace(const StageRow& row) const;

 private:
  [[nodiscard]] const StageRow* find(const std::string& seeds, const std::string& backend) const;
};

class StageBench {
 public:
  /// Throws Error{Usage} for an invalid request.
  explicit StageBench(StageRequest request);

  /// Each round runs every row once. A first round for warm-up is not counted.
  [[nodiscard]] StageMeasurement measure(const std::string& name, const std::filesystem::path& mesh,
                                         const RunControl& control);

 private:
  StageRequest request_;
  std::map<std::string, std::unique_ptr<Session>> sessions_;  ///< By backend.
};

}  // namespace asdfvk::bench
