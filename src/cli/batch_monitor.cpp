#include "cli/batch_monitor.h"

#include <fmt/core.h>

#include <chrono>
#include <utility>

#include "cli/terminal.h"
#include "core/text.h"

namespace asdfvk {
namespace {

constexpr double kTerminalSeconds = 0.2, kFurtherLineSeconds = 60;

}  // namespace

BatchMonitor::BatchMonitor(const CommandLine& line, const std::vector<MeshTask>& tasks)
    : line_(line), tasks_(tasks), waiting_(tasks.size()), isTerminal_(isStandardErrorTerminal()) {
  if (!line.batch.log.empty()) log_.emplace(line.batch.log);
  progress_.meshCount = tasks.size();
  for (const MeshTask& task : tasks) progress_.byteCount += task.byteCount;
  nextProgressSeconds_ = firstProgressSeconds();
  if (!line.batch.isBatch() || line.outputs.quiet) return;
  ticker_ = std::jthread([this](const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    const auto interval = std::chrono::duration<double>(kTerminalSeconds);
    while (!wakesTicker_.wait_for(lock, stop, interval, [&] { return stop.stop_requested(); })) showProgress();
  });
}

BatchMonitor::~BatchMonitor() = default;

void BatchMonitor::beginComputation() {
  const std::scoped_lock lock(mutex_);
  watch_ = Stopwatch();
  nextProgressSeconds_ = firstProgressSeconds();
}

void BatchMonitor::announce(const std::string& backend, const std::string& deviceLines) {
  const std::scoped_lock lock(mutex_);
  if (!announcedBackends_.empty()) return;
  announcedBackends_.insert(backend);
  if (line_.outputs.quiet) return;
  wipeProgress();
  writeStandardError(deviceLines);
}

void BatchMonitor::note(const std::string& lines) {
  if (line_.outputs.quiet) return;
  const std::scoped_lock lock(mutex_);
  wipeProgress();
  writeStandardError(lines);
}

/// The backend of --backend auto changes where its device fails. Outside of a batch the report has a warning.
void BatchMonitor::noteOtherBackend(MeshRun& run, const std::string& input) {
  const MeshRecord& record = run.record;
  if (!line_.batch.isBatch() || line_.outputs.quiet || record.backend.empty() || record.status == MeshStatus::Skipped)
    return;
  if (announcedBackends_.insert(record.backend).second)
    run.text += warningLine(input, fmt::format("computed with --backend {}, {}", record.backend, record.device));
}

void BatchMonitor::add(size_t task, MeshRun run) {
  const std::scoped_lock lock(mutex_);
  code_.add(run.code);
  noteOtherBackend(run, tasks_[task].input);
  progress_.count(run.record, tasks_[task].byteCount);
  if (run.record.status == MeshStatus::Dropped) dropped_.push_back(tasks_[task].input);
  if (log_) log_->append(run.record);
  waiting_[task] = {line_.outputs.json ? std::move(run.json) : std::string(), std::move(run.text)};
  printInOrder();
  showProgress();
}

ExitCode BatchMonitor::finish() {
  ticker_ = {};
  const std::scoped_lock lock(mutex_);
  wipeProgress();
  for (std::optional<Texts>& texts : waiting_)
    if (texts) print(*std::exchange(texts, std::nullopt));
  if (line_.batch.isBatch() && !line_.outputs.quiet) {
    if (!dropped_.empty())
      writeStandardError(oneLine(fmt::format("asdf-vk: dropped: {}", joined(dropped_, ", "))) + "\n");
    writeStandardError(fmt::format("asdf-vk: {}\n", summaryText(progress_, watch_.seconds())));
  }
  return code_.code();
}

bool BatchMonitor::hasUnfinished() const {
  const std::scoped_lock lock(mutex_);
  return !dropped_.empty() || progress_.finishedCount() < progress_.meshCount;
}

void BatchMonitor::print(const Texts& texts) {
  if (!texts.text.empty()) writeStandardError(texts.text);
  if (!texts.json.empty()) writeStandardOutput(texts.json);
}

void BatchMonitor::printInOrder() {
  for (; nextPrinted_ < waiting_.size() && waiting_[nextPrinted_]; ++nextPrinted_) {
    if (!waiting_[nextPrinted_]->text.empty()) wipeProgress();
    print(*std::exchange(waiting_[nextPrinted_], std::nullopt));
  }
}

void BatchMonitor::showProgress() {
  if (!line_.batch.isBatch() || line_.outputs.quiet || progress_.finishedCount() == progress_.meshCount) return;
  const double seconds = watch_.seconds();
  if (seconds < nextProgressSeconds_) return;
  const std::string text = progressText(progress_, seconds);
  if (isTerminal_) {
    writeStandardError(fmt::format("{}{} {}", kWipeLine, progressBarText(progress_.share()), text));
    isProgressVisible_ = true;
  } else {
    writeStandardError(fmt::format("asdf-vk: {}\n", text));
  }
  nextProgressSeconds_ = seconds + (isTerminal_ ? kTerminalSeconds : kFurtherLineSeconds);
}

void BatchMonitor::wipeProgress() {
  if (!isProgressVisible_) return;
  writeStandardError(kWipeLine);
  isProgressVisible_ = false;
}

}  // namespace asdfvk
