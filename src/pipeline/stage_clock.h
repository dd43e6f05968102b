#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <utility>

#include "asdf_vk/report.h"
#include "core/device_seconds.h"

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

  /// While it exists, the clock adds the time of a device to the stages in which it passes.
  class DeviceWatch {
   public:
    /// now(): the time of the device since a fixed moment.
    DeviceWatch(StageClock& clock, std::function<DeviceSeconds()> now, DeviceTimes& times) : clock_(clock) {
      clock_.deviceNow_ = std::move(now);
      clock_.deviceTimes_ = &times;
      clock_.lastDevice_ = clock_.deviceNow_();
    }
    ~DeviceWatch() { clock_.deviceTimes_ = nullptr; }
    DeviceWatch(const DeviceWatch&) = delete;
    DeviceWatch& operator=(const DeviceWatch&) = delete;

   private:
    StageClock& clock_;
  };

  void transfer(Stage from, Stage to, double seconds) {
    seconds_[from] -= seconds;
    seconds_[to] += seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<Stage> switchTo(std::optional<Stage> stage) {
    const Clock::time_point now = Clock::now();
    if (current_) seconds_[*current_] += std::chrono::duration<double>(now - lastSwitch_).count();
    if (deviceTimes_ != nullptr) addDeviceTimes();
    lastSwitch_ = now;
    if (stage && stage != current_ && began_) began_(*stage);
    return std::exchange(current_, stage);
  }

  void addDeviceTimes() {
    const DeviceSeconds last = std::exchange(lastDevice_, deviceNow_());
    if (!current_) return;
    deviceTimes_->kernels[*current_] += lastDevice_.kernels - last.kernels;
    deviceTimes_->copies[*current_] += lastDevice_.copies - last.copies;
  }

  StageSeconds& seconds_;
  std::function<void(Stage)> began_;
  Clock::time_point lastSwitch_ = Clock::now();
  std::optional<Stage> current_;
  std::function<DeviceSeconds()> deviceNow_;
  DeviceTimes* deviceTimes_ = nullptr;
  DeviceSeconds lastDevice_;
};

}  // namespace asdfvk
