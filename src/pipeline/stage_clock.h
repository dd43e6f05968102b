#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <utility>

#include "asdf_vk/report.h"

namespace asdfvk {

/// Wall-clock time of the stages of one computation. A Scope measures one stage; a nested Scope pauses the enclosing
/// one, so that no time is counted twice.
class StageClock {
 public:
  /// began: called whenever another stage begins or continues; may be empty.
  explicit StageClock(StageSeconds& seconds, std::function<void(Stage)> began = {})
      : seconds_(seconds), began_(std::move(began)) {}
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

  class Scope {
   public:
    Scope(StageClock& clock, Stage stage) : clock_(clock), enclosing_(clock.switchTo(stage)) {}
    ~Scope() { clock_.switchTo(enclosing_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    StageClock& clock_;
    std::optional<Stage> enclosing_;
  };
  [[nodiscard]] Scope time(Stage stage) { return {*this, stage}; }

  void transfer(Stage from, Stage to, double seconds) {
    seconds_[from] -= seconds;
    seconds_[to] += seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<Stage> switchTo(std::optional<Stage> stage) {
    const Clock::time_point now = Clock::now();
    if (current_) seconds_[*current_] += std::chrono::duration<double>(now - lastSwitch_).count();
    lastSwitch_ = now;
    if (stage && stage != current_ && began_) began_(*stage);
    return std::exchange(current_, stage);
  }

  StageSeconds& seconds_;
  std::function<void(Stage)> began_;
  Clock::time_point lastSwitch_ = Clock::now();
  std::optional<Stage> current_;
};

}  // namespace asdfvk
