#pragma once

#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "batch/job.h"
#include "cli/one_mesh.h"

namespace asdfvk {

/// Makes the records of jobs, and keeps them beside the outputs of a batch.
class JobRecords {
 public:
  /// The settings must outlive this object.
  explicit JobRecords(const MeshSettings& settings);

  [[nodiscard]] const Json& options() const { return options_; }

  /// The record of a job whose computation begins.
  [[nodiscard]] MeshRecord begin(const Job& job) const;

  /// Completes the record and writes it beside the output; where that fails, the mesh fails and has no result. old: the
  /// record of an earlier run, whose output is removed if the mesh failed and the output is out of date.
  [[nodiscard]] JobResult finish(const Job& job, MeshRecord record, MeshRun run,
                                 const std::optional<MeshRecord>& old) const;

  /// The result of an earlier run that is up to date.
  [[nodiscard]] std::optional<JobResult> findFinished(const Job& job) const;

  /// The result of a job that was not computed.
  [[nodiscard]] JobResult fail(const Job& job, const Failure& failure) const;

 private:
  const MeshSettings& settings_;
  std::string optionsHash_;
  Json options_;
};

/// Throws the failure as OpenFailure.
[[noreturn]] void throwOpenFailure(const Failure& failure);

/// Computes meshes with one session.
class MeshComputer : public JobComputer {
 public:
  /// showsBar: shows the progress of each mesh on a terminal. The references must outlive this object. Throws
  /// OpenFailure.
  MeshComputer(const MeshSettings& settings, const JobRecords& records, std::stop_token stop, bool showsBar = false);

  /// Puts all results into a page, which the caller writes. jobs: all of the page. Both must outlive this object.
  void collectIn(Page& page, const std::vector<Job>& jobs);

  [[nodiscard]] ComputerDescription describe() const override;
  [[nodiscard]] JobResult compute(const Job& job, const Job* next) override;
  [[nodiscard]] bool isSpent() const override { return isSpent_; }

 private:
  [[nodiscard]] std::string nameInSharedPage(const Job& job) const;

  const MeshSettings& settings_;
  const JobRecords& records_;
  const std::stop_token stop_;
  bool showsBar_;
  std::unique_ptr<Session> session_;
  std::string backend_;
  bool isSpent_ = false;
  Page* page_ = nullptr;
  const std::vector<Job>* jobsOfPage_ = nullptr;
  std::future<LoadedMesh> ahead_;  ///< The last member: it uses the others.
};

}  // namespace asdfvk
