#include "batch/monitor.h"

#include <fmt/core.h>

#include <chrono>
#include <utility>

#include "core/text.h"
#include "process/terminal.h"

namespace asdfvk {
namespace {

constexpr double kTerminalSeconds = 0.2, kFurtherLineSeconds = 60;

}  // namespace

Monitor::Monitor(const MonitorOptions& options, const std::vector<Job>& jobs)
    : options_(options), jobs_(jobs), isTerminal_(isStandardErrorTerminal()) {
  if (!options.log.empty()) log_.emplace(options.log);
  progress_.meshCount = jobs.size();
  progress_.isCheck = options.isCheck;
  for (const Job& job : jobs) progress_.byteCount += job.byteCount;
  nextProgressSeconds_ = firstProgressSeconds();
  if (!options_.showsProgress || options_.isQuiet) return;
  ticker_ = std::jthread([this](const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    const auto interval = std::chrono::duration<double>(kTerminalSeconds);
    while (!wakesTicker_.wait_for(lock, stop, interval, [&] { return stop.stop_requested(); })) showProgress();
  });
}

Monitor::~Monitor() = default;

void Monitor::beginComputation() {
  const std::scoped_lock lock(mutex_);
  watch_ = Stopwatch();
  nextProgressSeconds_ = firstProgressSeconds();
}

void Monitor::announce(const ComputerDescription& computer) {
  const std::scoped_lock lock(mutex_);
  if (!announcedBackends_.empty()) return;
  announcedBackends_.insert(computer.backend);
  if (options_.isQuiet) return;
  wipeProgress();
  writeStandardError(computer.deviceLines);
}

void Monitor::note(const std::string& message) {
  if (options_.isQuiet) return;
  const std::scoped_lock lock(mutex_);
  wipeProgress();
  writeStandardError(warningLine("", message));
}

/// If announce() did not print the backend of the result, adds a message to the first result of this backend. Such a
/// backend runs after a failure of a device, for example. A run without a progress line (MonitorOptions::showsProgress)
/// needs no message, because the user sees the report of the mesh, and the report has the warning about the failure.
void Monitor::noteOtherBackend(JobResult& result) {
  const MeshRecord& record = result.record;
  if (!options_.showsProgress || options_.isQuiet || record.backend.empty() || record.status == MeshStatus::Skipped)
    return;
  if (announcedBackends_.insert(record.backend).second)
    result.messages +=
        warningLine(record.input, fmt::format("computed on the backend {}, {}", record.backend, record.device));
}

/// A second attempt is slower than a first one, and other options avoid it.
void Monitor::noteSecondAttempt(JobResult& result) const {
  const MeshRecord& record = result.record;
  if (options_.isQuiet || record.attemptCount < 2 || !record.faceCount || record.status == MeshStatus::Skipped) return;
  result.messages += warningLine(record.input,
                                 "computed in a second attempt, alone, because the first worker process was killed for "
                                 "its memory; fewer jobs at once need less memory");
}

void Monitor::add(size_t job, JobResult result) {
  const std::scoped_lock lock(mutex_);
  const MeshRecord& record = result.record;
  codes_.insert(record.code);
  noteOtherBackend(result);
  noteSecondAttempt(result);
  progress_.count(record, job < jobs_.size() ? jobs_[job].byteCount : 0);
  if (record.status == MeshStatus::Dropped) dropped_.push_back(record.input);
  if (log_) log_->append(record);
  if (options_.keepsRecords) records_.emplace(job, record);
  waiting_[job] = {options_.printsReports ? std::move(result.report) : std::string(), std::move(result.messages)};
  printInOrder();
  showProgress();
}

void Monitor::finish() {
  ticker_ = {};
  const std::scoped_lock lock(mutex_);
  wipeProgress();
  for (const auto& [job, texts] : waiting_) print(texts);
  if (options_.showsProgress && !options_.isQuiet) {
    if (!dropped_.empty())
      writeStandardError(oneLine(fmt::format("asdf-vk: dropped: {}", joined(dropped_, ", "))) + "\n");
    writeStandardError(fmt::format("asdf-vk: {}\n", summaryText(progress_, watch_.seconds())));
  }
}

std::vector<MeshRecord> Monitor::records() const {
  const std::scoped_lock lock(mutex_);
  std::vector<MeshRecord> records;
  for (const auto& [job, record] : records_) records.push_back(record);
  return records;
}

std::vector<size_t> Monitor::unfinishedJobs() const {
  const std::scoped_lock lock(mutex_);
  std::vector<size_t> jobs;
  for (size_t i = nextPrinted_; i < jobs_.size(); ++i)
    if (!waiting_.contains(i)) jobs.push_back(i);
  return jobs;
}

bool Monitor::hasUnfinished() const {
  const std::scoped_lock lock(mutex_);
  return !dropped_.empty() || progress_.finishedCount() < progress_.meshCount;
}

void Monitor::print(const Texts& texts) {
  if (!texts.messages.empty()) writeStandardError(texts.messages);
  if (!texts.report.empty()) writeStandardOutput(texts.report);
}

void Monitor::printInOrder() {
  for (auto next = waiting_.begin(); next != waiting_.end() && next->first == nextPrinted_; ++nextPrinted_) {
    if (!next->second.messages.empty()) wipeProgress();
    print(next->second);
    next = waiting_.erase(next);
  }
}

void Monitor::showProgress() {
  if (!options_.showsProgress || options_.isQuiet || progress_.finishedCount() == progress_.meshCount) return;
  const double seconds = watch_.seconds();
  if (seconds < nextProgressSeconds_) return;
  const std::string text = progressText(progress_, seconds);
  if (isTerminal_) {
    const std::string bar = progress_.meshCount == 0 ? "" : progressBarText(progress_.share()) + " ";
    writeStandardError(fmt::format("{}{}{}", kWipeLine, bar, text));
    isProgressVisible_ = true;
  } else {
    writeStandardError(fmt::format("asdf-vk: {}\n", text));
  }
  nextProgressSeconds_ = seconds + (isTerminal_ ? kTerminalSeconds : kFurtherLineSeconds);
}

void Monitor::wipeProgress() {
  if (!isProgressVisible_) return;
  writeStandardError(kWipeLine);
  isProgressVisible_ = false;
}

}  // namespace asdfvk
