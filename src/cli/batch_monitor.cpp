#include "cli/batch_monitor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "cli/terminal.h"

namespace asdfvk {
namespace {

constexpr double kTerminalSeconds = 0.2, kFirstLineSeconds = 10, kFurtherLineSeconds = 60;
constexpr std::string_view kWipe = "\r\x1b[K";

}  // namespace

BatchMonitor::BatchMonitor(const CommandLine& line, const std::vector<MeshTask>& tasks)
    : line_(line), tasks_(tasks), waiting_(tasks.size()), isTerminal_(isStandardErrorTerminal()) {
  if (!line.batch.log.empty()) log_.emplace(line.batch.log);
  progress_.meshCount = tasks.size();
  for (const MeshTask& task : tasks) progress_.byteCount += task.byteCount;
  nextProgressSeconds_ = isTerminal_ ? 1 : kFirstLineSeconds;
}

void BatchMonitor::add(size_t task, MeshRun run) {
  const std::scoped_lock lock(mutex_);
  code_.add(run.code);
  progress_.count(run.record, tasks_[task].byteCount);
  if (run.record.status == MeshStatus::Dropped) dropped_.push_back(tasks_[task].input);
  if (log_) log_->append(run.record);
  waiting_[task] = {line_.json ? std::move(run.json) : std::string(), std::move(run.text)};
  printInOrder();
  showProgress();
}

ExitCode BatchMonitor::finish() {
  const std::scoped_lock lock(mutex_);
  wipeProgress();
  for (std::optional<Texts>& texts : waiting_)
    if (texts) print(*std::exchange(texts, std::nullopt));
  if (line_.batch.isBatch() && !line_.quiet) {
    if (!dropped_.empty())
      writeStandardError(oneLine(fmt::format("asdf-vk: dropped: {}", fmt::join(dropped_, ", "))) + "\n");
    writeStandardError(fmt::format("asdf-vk: {}\n", summaryText(progress_, watch_.seconds())));
  }
  return code_.code();
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
  if (!line_.batch.isBatch() || line_.quiet || progress_.finishedCount() == progress_.meshCount) return;
  const double seconds = watch_.seconds();
  if (seconds < nextProgressSeconds_) return;
  const std::string text = progressText(progress_, seconds);
  if (isTerminal_) {
    writeStandardError(fmt::format("{}{} {}", kWipe, progressText(progress_.share()), text));
    isProgressVisible_ = true;
  } else {
    writeStandardError(fmt::format("asdf-vk: {}\n", text));
  }
  nextProgressSeconds_ = seconds + (isTerminal_ ? kTerminalSeconds : kFurtherLineSeconds);
}

void BatchMonitor::wipeProgress() {
  if (!isProgressVisible_) return;
  writeStandardError(kWipe);
  isProgressVisible_ = false;
}

}  // namespace asdfvk
