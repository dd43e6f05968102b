#include "cli/mesh_jobs.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "asdf_vk/asdf_vk.h"
#include "asdf_vk/version.h"
#include "batch/content_hash.h"
#include "batch/output_record.h"
#include "batch/process_memory.h"
#include "cli/device_output.h"
#include "cli/member_files.h"
#include "cli/page_output.h"
#include "cli/report_json.h"
#include "cli/report_text.h"
#include "core/json.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "describe/report_json.h"
#include "pipeline/backend_choice.h"

namespace asdfvk {
namespace {

/// Removes lists, but not points.
Json withoutLists(Json object) {
  Json kept;
  for (auto& [key, value] : object.items())
    if (!value.is_array() || isKeptInRecord(key))
      kept[key] = value.is_object() ? withoutLists(std::move(value)) : std::move(value);
  return kept;
}

void fillRecord(MeshRecord& record, const Report& report) {
  const Json json = toJson(report);
  record.sdf = json.at("sdf");
  record.thickness = withoutLists(json.at("thickness"));
  record.parts = withoutLists(json.at("parts"));
  record.estimatedError = withoutLists(json.at("estimatedError"));
  record.findings = json.at("findings");
  record.faceCount = report.faceCount;
  record.vertexCount = report.vertexCount;
  record.componentCount = report.componentCount;
  record.noValueCount = report.noValueCount;
  record.segmentCount = report.segmentCount;
  record.unit = report.unit;
  record.device = report.device;
  record.backend = report.backend;
  for (size_t i = 0; i < kStageCount; ++i)
    if (const double seconds = report.stageSeconds.seconds[i]; seconds > 0)
      record.seconds[nameOf(static_cast<Stage>(i))] = seconds;
  for (const Warning& warning : report.warnings) record.warnings.emplace_back(nameOf(warning.code));
}

void fillRecord(MeshRecord& record, const Failure& failure) {
  record.status = failure.code == ExitCode::Cancelled ? MeshStatus::Dropped : MeshStatus::Failed;
  record.code = static_cast<int>(failure.code);
  record.error = failure.name;
  record.message = failure.message;
}

std::unique_ptr<Session> openSession(const SessionOptions& options) {
  try {
    return std::make_unique<Session>(options);
  } catch (...) {
    throwOpenFailure(currentFailure(options.requireGpu));
  }
}

/// Whether a file is read during the preceding computation. False for large files, because both meshes are then in
/// memory at the same time.
bool isReadAhead(const Job& job) {
  constexpr uint64_t kMaxBytes = uint64_t{256} << 20;
  return !job.isStream && job.byteCount > 0 && job.byteCount <= kMaxBytes;
}

}  // namespace

bool isKeptInRecord(std::string_view key) { return key == "minPlace" || key == "minOpposite"; }

JobRecords::JobRecords(const MeshSettings& settings)
    : settings_(settings),
      optionsHash_(optionsHash(settings.computation, settings.session, settings.reading, settings.outputs)),
      options_(optionValues(settings.computation, settings.session)) {
  const CheckPolicy& policy = settings.policy;
  if (!policy.limits.rules.empty() || !policy.baseline.places.empty())
    optionsHash_ = contentHash(optionsHash_ + jsonText({policy.limits, policy.baseline.places}));
}

MeshRecord JobRecords::begin(const Job& job) const {
  MeshRecord record;
  record.input = job.input;
  record.key = job.key;
  record.attemptCount = job.attemptCount;
  record.time = utcTime();
  record.optionsHash = optionsHash_;
  record.options = options_;
  record.version = ASDFVK_VERSION;
  record.commit = ASDFVK_COMMIT;
  return record;
}

namespace {

/// Removes the picture of an earlier run in which the mesh failed the check.
void removeOldPicture(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) std::filesystem::remove(path, ignored);
}

}  // namespace

JobResult JobRecords::finish(const Job& job, MeshRecord record, MeshRun run,
                             const std::optional<MeshRecord>& old) const {
  if (run.report) fillRecord(record, *run.report);
  if (run.hasResult && !job.output.empty()) record.output = job.output;
  if (!run.picture.empty()) record.picture = run.picture;
  if (run.failure) fillRecord(record, *run.failure);
  if (!record.picture && record.status != MeshStatus::Dropped) removeOldPicture(job.picture);
  if (settings_.isOfBatch && !job.content && run.hasResult) {
    try {
      writeOutputRecord(record, job.output);
    } catch (...) {
      run.add(currentFailure(), job.input, settings_.outputs.json && !run.failure);
      fillRecord(record, *run.failure);
      removeOutput(record, job.output);
      record.output.reset();
      record.outputHash.clear();
    }
  }
  if (old && record.status == MeshStatus::Failed && !hasResult(run.failure->code))
    removeOutdatedOutput(*old, record, job.output);
  return {std::move(record), std::move(run.json), std::move(run.text)};
}

std::string JobRecords::inputHashOf(const std::string& input) const {
  const bool mayHaveFilesBeside = lowerCase(std::filesystem::path(input).extension().string()) == ".gltf";
  return mayHaveFilesBeside ? loadMesh(input, settings_.reading, true, {}).hash : contentHashOf(input).value_or("");
}

std::optional<JobResult> JobRecords::findFinished(const Job& job) const {
  std::error_code ignored;
  if (!std::filesystem::exists(outputRecordPath(job.output), ignored)) return std::nullopt;
  MeshRecord expected = begin(job);
  expected.inputHash = inputHashOf(job.input);
  std::optional<MeshRecord> found = findFinishedOutput(expected, job.output);
  if (!found || lacksPicture(job, *found)) return std::nullopt;
  std::string report = jsonSkipped(job.input, *found);
  std::string verdict;
  if (found->code != 0) verdict = oneLine(fmt::format("asdf-vk: {}: {}", job.input, found->message)) + "\n";
  return JobResult{std::move(*found), std::move(report), std::move(verdict)};
}

bool JobRecords::lacksPicture(const Job& job, const MeshRecord& finished) const {
  std::error_code ignored;
  if (!hasPictureFolder(settings_.outputs) || std::filesystem::exists(job.picture, ignored)) return false;
  return !isCheck(settings_.computation, settings_.outputs) || finished.code == static_cast<int>(ExitCode::OverLimit);
}

JobResult JobRecords::fail(const Job& job, const Failure& failure) const {
  MeshRecord record = begin(job);
  MeshRun run;
  run.add(failure, job.input, settings_.outputs.json);
  const std::optional<MeshRecord> old = job.content ? std::nullopt : readOutputRecord(job.output);
  if (old) record.inputHash = contentHashOf(job.input).value_or("");
  return finish(job, std::move(record), std::move(run), old);
}

void throwOpenFailure(const Failure& failure) {
  throw OpenFailure(static_cast<int>(failure.code), failure.name, failure.message);
}

MeshComputer::MeshComputer(const MeshSettings& settings, const JobRecords& records, std::stop_token stop, bool showsBar)
    : settings_(settings),
      records_(records),
      stop_(std::move(stop)),
      showsBar_(showsBar),
      sessionOptions_(sessionOptionsFor(settings.session, settings.computation.options)),
      session_(openSession(sessionOptions_)),
      backend_(session_->backend()) {}

void MeshComputer::collectIn(Page& page, const std::vector<Job>& jobs) {
  page_ = &page;
  jobsOfPage_ = &jobs;
}

const MeshSettings& MeshComputer::settingsOf(const Job& job) {
  if (!hasPictureFolder(settings_.outputs)) return settings_;
  if (!drawingSettings_) drawingSettings_.emplace(settings_).drawsFailedOnly = true;
  drawingSettings_->outputs.picture = job.picture;
  return *drawingSettings_;
}

ComputerDescription MeshComputer::describe() const {
  return {session_->backend(), deviceLinesOf(*session_, sessionOptions_, settings_.outputs.verbose),
          session_->runsOnCpu()};
}

JobResult MeshComputer::compute(const Job& job, const Job* next) {
  MeshRecord record = records_.begin(job);
  const std::optional<MeshRecord> old =
      settings_.isOfBatch && !job.content ? readOutputRecord(job.output) : std::nullopt;
  const Stopwatch watch;
  resetPeakMemory();
  const Deadline deadline(settings_.timeoutSeconds, stop_);
  LoadedMesh loaded = job.content      ? loadMember(job.input, *job.content, settings_.reading, settings_.isOfBatch)
                      : ahead_.valid() ? ahead_.get()
                                       : loadMesh(job.input, settings_.reading, settings_.isOfBatch, deadline.token());
  if (next != nullptr && isReadAhead(*next))
    ahead_ = std::async(std::launch::async,
                        [this, next] { return loadMesh(next->input, settings_.reading, settings_.isOfBatch, stop_); });
  record.inputHash = loaded.hash;
  std::optional<SharedPage> page;
  if (page_ != nullptr) page.emplace(SharedPage{*page_, nameInSharedPage(job)});
  MeshRun run = computeMesh(*session_, job.input, job.output, std::move(loaded), settingsOf(job), deadline,
                            {.showsBar = showsBar_}, page ? &*page : nullptr);
  isSpent_ = session_->backend() != backend_ || stop_.stop_requested() ||
             (run.failure && run.failure->code == ExitCode::Device);
  record.totalSeconds = watch.seconds();
  record.peakMemoryBytes = peakMemoryBytes();
  std::vector<std::pair<std::string, std::string>> files;
  if (job.content && !job.output.empty()) files = takenResult(job.output);
  if (!files.empty()) record.outputHash = contentHash(files.back().second);
  JobResult result = records_.finish(job, std::move(record), std::move(run), old);
  result.files = std::move(files);
  return result;
}

/// The file name, or the whole path if another mesh of the page has the same file name.
std::string MeshComputer::nameInSharedPage(const Job& job) const {
  const std::string name = nameInPage(job.input);
  const auto sameCount = std::count_if(jobsOfPage_->begin(), jobsOfPage_->end(),
                                       [&](const Job& other) { return nameInPage(other.input) == name; });
  return sameCount > 1 ? job.input : name;
}

}  // namespace asdfvk
