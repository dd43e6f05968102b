#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "batch/engine.h"
#include "batch/monitor.h"
#include "batch/tar_feed.h"
#include "cli/mesh_jobs.h"

namespace asdfvk {

/// The members of tars as jobs. Writes the answers to the tars Job::output in the order of the members, and adds a
/// result per member to the monitor. A tar that was not read to its end has a failed record of its own, and its output
/// does not appear.
class TarStream final : public JobStream {
 public:
  /// tars: inputs and outputs; an empty output for none. With --skip-existing, adds tars whose output is up to date as
  /// skipped. Precondition: the arguments outlive this object.
  TarStream(const std::vector<Job>& tars, const MeshSettings& settings, const JobRecords& records, Monitor& monitor,
            const BatchOptions& batch, const std::stop_token& stop);

  [[nodiscard]] JobSupply::State next() override;
  [[nodiscard]] int descriptor() const override { return feed_->descriptor(); }
  [[nodiscard]] Job take(size_t index) override;
  void add(size_t index, JobResult result) override;

  /// Ends the outputs that are not complete. Returns the tars that have no record yet.
  [[nodiscard]] std::vector<Job> finish();

 private:
  struct Entry {
    TarItem item;
    uint64_t heldBytes = 0;
    bool isDone = false;
    JobResult result = {};
  };

  [[nodiscard]] MeshRecord beginTar(const Job& tar) const;
  [[nodiscard]] Job jobOf(const TarItem& item) const;
  void writeDone();
  void write(Entry& entry);
  void writeAnswer(const TarItem& item, JobResult result);
  void endTar(const TarItem& item);

  const std::vector<Job>& tars_;
  const MeshSettings& settings_;
  const BatchOptions& batch_;
  const JobRecords& records_;
  Monitor& monitor_;
  std::vector<size_t> pending_;  ///< The tars that are read, as indices of tars_.
  size_t endedCount_ = 0;        ///< Number of tars of pending_ that have ended.
  std::optional<TarFeed> feed_;
  std::deque<Entry> entries_;         ///< In the order of the output.
  std::deque<Entry*> waiting_;        ///< Meshes that take() has not returned yet.
  std::map<size_t, Entry*> current_;  ///< Meshes that workers compute, by job.
  size_t addedCount_ = 0;             ///< Number of results that the monitor has.
  std::optional<TarWriter> writer_;
  MeshRecord record_;  ///< The record of the current tar.
  SharedExitCode code_;
  size_t memberCount_ = 0, failedCount_ = 0;
  bool isInterrupted_ = false;  ///< Whether a mesh was dropped. This tar and the next ones are not complete.
};

}  // namespace asdfvk
