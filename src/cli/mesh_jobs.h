#pragma once

#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "batch/job.h"
#include "cli/one_mesh.h"

namespace asdfvk {

/// Whether records have a list of this key of `thickness`, `parts` and `estimatedError`.
[[nodiscard]] bool isKeptInRecord(std::string_view key);

/// Makes the records of jobs. In a batch, writes each record to a file beside the output.
class JobRecords {
 public:
  /// Precondition: `settings` outlives this object.
  explicit JobRecords(const MeshSettings& settings);

  [[nodiscard]] const Json& options() const { return options_; }

  /// Makes the record of a job whose computation begins.
  [[nodiscard]] MeshRecord begin(const Job& job) const;

  /// Completes the record and, in a batch, writes it beside the output. If the record cannot be written, the mesh fails
  /// and its output is removed. A verdict remains the failure of the mesh. old: record of an earlier run. If the mesh
  /// failed, an outdated output is removed.
  [[nodiscard]] JobResult finish(const Job& job, MeshRecord record, MeshRun run,
                                 const std::optional<MeshRecord>& old) const;

  [[nodiscard]] std::optional<JobResult> findFinished(const Job& job) const;

  /// The result of a job whose worker process failed.
  [[nodiscard]] JobResult fail(const Job& job, const Failure& failure) const;

 private:
  [[nodiscard]] std::string inputHashOf(const std::string& input) const;
  /// Whether the picture of an earlier result is missing.
  [[nodiscard]] bool lacksPicture(const Job& job, const MeshRecord& finished) const;

  const MeshSettings& settings_;
  std::string optionsHash_;
  Json options_;
};

[[noreturn]] void throwOpenFailure(const Failure& failure);

class MeshComputer : public JobComputer {
 public:
  /// showsBar: shows a progress bar for each mesh if standard error is a terminal. Precondition: `settings` and
  /// `records` outlive this object. Throws OpenFailure.
  MeshComputer(const MeshSettings& settings, const JobRecords& records, std::stop_token stop, bool showsBar = false);

  /// Adds all results to `page` instead of writing them. The caller writes the page. jobs: all jobs of the page.
  /// Precondition: `page` and `jobs` outlive this object.
  void collectIn(Page& page, const std::vector<Job>& jobs);

  [[nodiscard]] ComputerDescription describe() const override;
  [[nodiscard]] JobResult compute(const Job& job, const Job* next) override;
  [[nodiscard]] bool isSpent() const override { return isSpent_; }

 private:
  [[nodiscard]] std::string nameInSharedPage(const Job& job) const;
  /// The settings with the picture of the job.
  [[nodiscard]] const MeshSettings& settingsOf(const Job& job);

  const MeshSettings& settings_;
  std::optional<MeshSettings> drawingSettings_;  ///< If each job has a picture of its own.
  const JobRecords& records_;
  const std::stop_token stop_;
  bool showsBar_;
  const SessionOptions sessionOptions_;
  std::unique_ptr<Session> session_;
  std::string backend_;
  bool isSpent_ = false;
  Page* page_ = nullptr;
  const std::vector<Job>* jobsOfPage_ = nullptr;
  /// Last member, because its destructor waits for a task that uses the other members.
  std::future<LoadedMesh> ahead_;
};

}  // namespace asdfvk
