#pragma once

#include <functional>
#include <optional>

#include "core/stopwatch.h"
#include "estimate/error_estimate.h"
#include "pipeline/interpolation.h"
#include "pipeline/seed_choice.h"

namespace asdfvk {

/// Chooses seeds, casts their rays, interpolates and estimates the error, once or in rounds that keep what the rounds
/// before have traced.
class SeedRounds {
 public:
  /// What it refers to must outlive it. clock: runs since the beginning of the computation, for a time budget.
  /// afterLastRay: called as soon as it is certain that no more rays will be cast, if that is before the end, so that
  /// what casts them need not stand beside what interpolates.
  SeedRounds(const TriangleMesh& mesh, const PreparedMesh& prepared, const Options& options, SeedTracing& tracing,
             Interpolation& interpolation, const Stopwatch& clock, StageSeconds& seconds,
             std::function<void()> afterLastRay);

  void run(const RunControl& control);

  [[nodiscard]] const TracedSeeds& traced() const { return traced_; }  ///< All of them.
  [[nodiscard]] const Interpolated& result() const { return result_; }
  [[nodiscard]] const std::optional<EstimatedErrors>& errors() const { return errors_; }
  [[nodiscard]] uint32_t roundCount() const { return roundCount_; }

 private:
  /// isLast: no other round will follow.
  void runRound(uint64_t count, bool isLast, const RunControl& control);
  void traceChosen(const SeedShares& shares, std::span<const double> weight, const RunControl& control);
  void sortChosen();
  /// What the probes are judged by, #F each.
  struct HeldOut {
    std::vector<double> pattern;  ///< See errorPattern(); empty without a prediction.
    std::vector<double> values;   ///< Interpolated without probes and scouts.
  };
  /// Returns the pattern of errors. seconds: what it took is added.
  [[nodiscard]] std::vector<double> predictWithoutProbes(double& seconds);
  /// Traces the faces with the greatest predictions, which are returned, and probes by the pattern.
  std::vector<uint32_t> traceByPrediction(const SeedShares& shares, std::span<const double> pattern,
                                          const RunControl& control);
  /// Interpolates without the probes and without these scouts.
  [[nodiscard]] std::vector<double> holdOut(std::span<const uint32_t> scouts, const RunControl& control);
  void estimate(const HeldOut& heldOut);
  /// 0: it is enough.
  [[nodiscard]] uint64_t furtherCount() const;
  [[nodiscard]] uint64_t countForError() const;
  [[nodiscard]] uint64_t countForTime() const;
  [[nodiscard]] uint64_t leftCount() const;

  TriangleMesh mesh_;
  const PreparedMesh& prepared_;
  const Options& options_;
  SeedTracing& tracing_;
  Interpolation& interpolation_;
  const Stopwatch& clock_;
  StageSeconds& seconds_;
  std::function<void()> afterLastRay_;
  bool estimates_;

  SeedChoice chosen_;
  TracedSeeds traced_;
  Probes probes_;  ///< Of the seeds traced: those that were chosen at random to judge by.
  Interpolated result_;
  std::optional<EstimatedErrors> errors_;
  double interpolationSeconds_ = 0;  ///< What the last round spent on other things than rays.
  uint32_t roundCount_ = 0;
};

}  // namespace asdfvk
