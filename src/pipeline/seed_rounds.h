#pragma once

#include <optional>

#include "core/stopwatch.h"
#include "pipeline/error_estimate.h"
#include "pipeline/interpolation.h"
#include "pipeline/seed_choice.h"

namespace asdfvk {

/// Chooses seeds, casts their rays, interpolates and estimates the error, once or in rounds that keep what the rounds
/// before have traced.
class SeedRounds {
 public:
  /// What it refers to must outlive it. clock: runs since the beginning of the computation, for a time budget.
  SeedRounds(const Mesh& mesh, const PreparedMesh& prepared, const Options& options, SeedTracing& tracing,
             Interpolation& interpolation, const Stopwatch& clock, StageSeconds& seconds);

  void run(const RunControl& control);

  [[nodiscard]] const TracedSeeds& traced() const { return traced_; }  ///< All of them.
  [[nodiscard]] const Interpolated& result() const { return result_; }
  [[nodiscard]] const std::optional<EstimatedErrors>& errors() const { return errors_; }
  [[nodiscard]] uint32_t roundCount() const { return roundCount_; }

 private:
  void runRound(uint64_t count, std::span<const double> weight, const RunControl& control);
  void traceChosen(const SeedShares& shares, std::span<const double> weight, const RunControl& control);
  /// Hides the values of the probes, or shows them again.
  void showProbes(bool areShown);
  void sortChosen();
  [[nodiscard]] KnownSeeds known(std::span<const uint32_t> faces) const {
    return {traced_.values, faces, traced_.hits};
  }
  /// What is interpolated without the probes, in two ways.
  struct HeldOut {
    std::vector<double> guided;
    std::vector<double> harmonic;  ///< #F, or empty where `guided` is harmonic itself.
  };
  /// Interpolates without the probes, and traces the scouts that this suggests.
  [[nodiscard]] HeldOut holdOut(const SeedShares& shares, const RunControl& control);
  void estimate(const HeldOut& heldOut);
  /// 0: it is enough.
  [[nodiscard]] uint64_t furtherCount() const;
  [[nodiscard]] uint64_t countForError() const;
  [[nodiscard]] uint64_t countForTime() const;
  [[nodiscard]] uint64_t leftCount() const;

  const Mesh& mesh_;
  const PreparedMesh& prepared_;
  const Options& options_;
  SeedTracing& tracing_;
  Interpolation& interpolation_;
  const Stopwatch& clock_;
  StageSeconds& seconds_;
  bool estimates_;

  SeedChoice chosen_;
  TracedSeeds traced_;
  std::vector<uint32_t> probes_;     ///< Of the seeds traced: those that were chosen at random to judge by.
  std::vector<double> probeValues_;  ///< One each.
  Interpolated result_;
  std::optional<EstimatedErrors> errors_;
  double interpolationSeconds_ = 0;  ///< What the last round spent on other things than rays.
  uint32_t roundCount_ = 0;
};

}  // namespace asdfvk
