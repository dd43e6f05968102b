#include "cli/tar_stream.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "asdf_vk/error.h"
#include "batch/archive_library.h"
#include "batch/content_hash.h"
#include "batch/output_record.h"
#include "batch/tar_names.h"
#include "cli/outputs.h"
#include "cli/report_json.h"
#include "core/parallel.h"
#include "core/text.h"

namespace asdfvk {
namespace {

namespace fs = std::filesystem;

void addMember(TarWriter& writer, const std::string& name, std::string_view bytes, int64_t time) {
  writer.begin({.name = name, .byteCount = bytes.size(), .time = time});
  writer.write(bytes);
}

Failure failureOfMember(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (...) {
    return currentFailure();
  }
}

uint64_t byteCountOf(const JobResult& result) {
  uint64_t count = result.report.size() + result.messages.size();
  for (const auto& [name, bytes] : result.files) count += bytes.size();
  return count;
}

}  // namespace

TarStream::TarStream(const std::vector<Job>& tars, const MeshSettings& settings, const JobRecords& records,
                     Monitor& monitor, const BatchOptions& batch, const std::stop_token& stop)
    : tars_(tars), settings_(settings), batch_(batch), records_(records), monitor_(monitor) {
  (void)archiveLibrary();  // Throws before the first tar.
  TarFeedOptions options{.paths = {}, .copiesMembers = batch.keepsMembers};
  constexpr size_t kItemsPerJob = 4;  // With members that are copied, a mesh has several items.
  options.maxItems = std::max(options.maxItems, kItemsPerJob * std::max<size_t>(batch.jobCount, threadLimit()));
  for (size_t i = 0; i < tars.size(); ++i) {
    std::optional<MeshRecord> finished;
    if (std::error_code ignored; batch.skipsExisting && fs::exists(outputRecordPath(tars[i].output), ignored)) {
      MeshRecord expected = beginTar(tars[i]);
      expected.inputHash = contentHashOf(tars[i].input).value_or("");
      finished = findFinishedOutput(expected, tars[i].output);
    }
    if (finished) {
      std::string report = jsonSkipped(tars[i].input, *finished);
      std::string message;
      if (finished->code != 0)
        message = oneLine(fmt::format("asdf-vk: {}: {}", tars[i].input, finished->message)) + "\n";
      monitor.add(addedCount_++,
                  {.record = std::move(*finished), .report = std::move(report), .messages = std::move(message)});
    } else {
      pending_.push_back(i);
      options.paths.push_back(tars[i].input);
    }
  }
  feed_.emplace(std::move(options), stop);
}

MeshRecord TarStream::beginTar(const Job& tar) const {
  MeshRecord record = records_.begin(tar);
  record.optionsHash = contentHash(record.optionsHash +
                                   fmt::format(" tar {} {}", batch_.keepsMembers, settings_.outputs.writesRecordsOnly));
  return record;
}

Job TarStream::jobOf(const TarItem& item) const {
  const Job& tar = tars_[pending_[item.tar]];
  const bool hasResult = !tar.output.empty() && !settings_.outputs.writesRecordsOnly;
  return {.input = tar.input == "-" ? item.member.name : tar.input + "/" + item.member.name,
          .output = hasResult ? item.stem + "." + settings_.outputs.format : std::string(),
          .byteCount = item.member.byteCount,
          .key = sampleKeyOf(item.member.name),
          .content = std::string()};
}

JobSupply::State TarStream::next() {
  while (std::optional<TarItem> item = feed_->take()) {
    const uint64_t heldBytes = item->bytes.size();
    const bool isMesh = item->kind == TarItem::Kind::Mesh;
    Entry& entry = entries_.emplace_back(Entry{std::move(*item), heldBytes, !isMesh});
    if (isMesh) waiting_.push_back(&entry);
  }
  writeDone();
  if (!waiting_.empty()) return JobSupply::State::Ready;
  return feed_->isEnded() ? JobSupply::State::Ended : JobSupply::State::Later;
}

Job TarStream::take(size_t index) {
  Entry& entry = *waiting_.front();
  waiting_.pop_front();
  current_[index] = &entry;
  Job job = jobOf(entry.item);
  job.content = std::exchange(entry.item.bytes, {});
  return job;
}

void TarStream::add(size_t index, JobResult result) {
  const auto current = current_.find(index);
  Entry& entry = *current->second;
  current_.erase(current);
  entry.result = std::move(result);
  entry.isDone = true;
  feed_->replaceBytes(entry.heldBytes, byteCountOf(entry.result));
  entry.heldBytes = byteCountOf(entry.result);
  writeDone();
}

void TarStream::writeDone() {
  for (; !entries_.empty() && entries_.front().isDone; entries_.pop_front()) {
    const uint64_t heldBytes = entries_.front().heldBytes;
    write(entries_.front());
    feed_->release(heldBytes);
  }
}

void TarStream::write(Entry& entry) {
  const TarItem& item = entry.item;
  switch (item.kind) {
    case TarItem::Kind::Begin: {
      const Job& tar = tars_[pending_[item.tar]];
      record_ = beginTar(tar);
      code_ = {};
      memberCount_ = failedCount_ = 0;
      if (!tar.output.empty() && !isInterrupted_) writer_.emplace(tar.output);
      break;
    }
    case TarItem::Kind::Copy:
      if (writer_) writer_->begin(item.member);
      [[fallthrough]];
    case TarItem::Kind::Piece:
      if (writer_) writer_->write(item.bytes);
      break;
    case TarItem::Kind::Mesh:
      writeAnswer(item, std::move(entry.result));
      break;
    case TarItem::Kind::Failed:
      writeAnswer(item, records_.fail(jobOf(item), failureOfMember(item.failure)));
      break;
    case TarItem::Kind::End:
      endTar(item);
      break;
  }
}

void TarStream::writeAnswer(const TarItem& item, JobResult result) {
  MeshRecord& record = result.record;
  ++memberCount_;
  if (!hasResult(static_cast<ExitCode>(record.code))) ++failedCount_;
  code_.add(static_cast<ExitCode>(record.code));
  isInterrupted_ = isInterrupted_ || record.status == MeshStatus::Dropped;
  if (writer_ && !item.stem.empty() && record.status != MeshStatus::Dropped) {
    for (const auto& [name, bytes] : result.files) addMember(*writer_, name, bytes, item.member.time);
    addMember(*writer_, item.stem + ".json", toJsonLine(record) + "\n", item.member.time);
  }
  monitor_.add(addedCount_++, std::move(result));
}

void TarStream::endTar(const TarItem& item) {
  if (isInterrupted_) return;  // finish() ends the output.
  const Job& tar = tars_[pending_[item.tar]];
  ++endedCount_;
  if (item.failure) {
    Failure failure = failureOfMember(item.failure);
    if (!tar.output.empty() && tar.output != "-") failure.message += fmt::format("; {} is not written", tar.output);
    if (writer_) writer_->abandon();
    writer_.reset();
    MeshRun run;
    run.add(failure, tar.input, settings_.outputs.json);
    monitor_.add(addedCount_++, records_.finish(tar, beginTar(tar), std::move(run), {}));
    return;
  }
  if (!writer_) return;
  removeOutputRecord(tar.output);
  writer_->commit();
  writer_.reset();
  record_.output = tar.output;
  record_.inputHash = item.hash;
  record_.code = static_cast<int>(code_.code());
  record_.message = fmt::format("{} of {} failed", groupDigits(failedCount_), counted(memberCount_, "mesh", "meshes"));
  writeOutputRecord(record_, tar.output);
}

std::vector<Job> TarStream::finish() {
  if (writer_) writer_->abandon();
  writer_.reset();
  std::vector<Job> unfinished;
  for (size_t i = endedCount_; i < pending_.size(); ++i) unfinished.push_back(tars_[pending_[i]]);
  return unfinished;
}

}  // namespace asdfvk
