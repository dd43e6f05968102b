#include "cli/request_computer.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "asdf_vk/error.h"
#include "cli/exit_code.h"
#include "cli/mesh_settings.h"
#include "cli/one_mesh.h"
#include "cli/request_mesh.h"
#include "core/parallel.h"
#include "describe/report_text.h"
#include "io/base64_text.h"
#include "process/interrupt.h"
#include "process/temporary_folder.h"

namespace asdfvk {
namespace {

namespace fs = std::filesystem;

AnsweredFile answeredFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
  return {fs::path(path).extension().string().substr(1), base64Text(bytes)};
}

RequestFailure requestFailure(const Failure& failure) {
  return {failure.name, failure.message, static_cast<int>(failure.code)};
}

Failure memoryFailure(uint64_t bytes) {
  return {ExitCode::Limit,
          fmt::format("the program exceeded --max-memory ({} bytes); use a coarser mesh, or allow more", bytes),
          "memoryLimit"};
}

/// Size of the mesh of a request, in bytes.
uint64_t sizeOf(const MeshRequest& request, const RequestFiles& files, const RequestContext& context) {
  std::error_code error;
  const uint64_t size = request.mesh.empty() ? 0 : fs::file_size(inputPath(request.mesh, files), error);
  return std::max<uint64_t>(context.byteCount, error ? 0 : size);
}

/// The rows of the full report, and behind the first one what to change at the places that fail.
ReportRows rowsWithRemedies(const Report& report) {
  constexpr size_t kMaxRemedies = 20;
  ReportRows rows = reportRows(report, OptionSpelling::CamelCase), remedies;
  for (const Finding& finding : report.findings)
    if (finding.level != FindingLevel::Note && remedies.size() < kMaxRemedies)
      remedies.emplace_back("to do", fmt::format("{}: {}", finding.message, finding.remedy));
  rows.insert(rows.begin() + 1, remedies.begin(), remedies.end());
  return rows;
}

bool isInline(const std::optional<RequestedFile>& file) { return file && file->path.empty(); }

}  // namespace

MeshRequestComputer::MeshRequestComputer(ServerSettings settings)
    : settings_(std::move(settings)),
      sessions_(settings_.session, settings_.workerCount),
      memory_(settings_.maxMemoryBytes) {}

MeshAnswer MeshRequestComputer::compute(const MeshRequest& request, const RequestContext& context,
                                        const std::function<void(double)>& progress) {
  const double timeoutSeconds = std::min(request.timeoutSeconds, settings_.timeoutSeconds);
  std::optional<MemoryLimit::Request> limited;
  std::optional<Deadline> deadline;
  MeshAnswer answer;
  try {
    limited.emplace(memory_, sizeOf(request, settings_.files, context), context.stop);
    deadline.emplace(timeoutSeconds, limited->token());
    if (context.stop.stop_requested()) throw Error(ErrorCode::Cancelled, "cancelled");
    const auto threads = static_cast<uint32_t>(std::max<size_t>(threadLimit() / context.sharerCount, 1));
    const auto compute = [&] { answer = computeWithin(request, context, progress, timeoutSeconds, *deadline); };
    if (context.sharerCount == 1)
      compute();
    else
      callWithThreads(threads, compute);
  } catch (...) {
    Failure failure = currentFailure(settings_.session.requireGpu);
    if (failure.code == ExitCode::Cancelled && deadline && deadline->hasExpired())
      failure = timeLimitFailure(timeoutSeconds);
    answer = {.report = {}, .failure = requestFailure(failure), .output = {}, .picture = {}};
  }
  if (answer.report.empty() && answer.failure && answer.failure->code == cancelledFailure().name && limited &&
      limited->hasExceeded())
    answer.failure = requestFailure(memoryFailure(memory_.bytes()));
  return answer;
}

MeshAnswer MeshRequestComputer::computeWithin(const MeshRequest& request, const RequestContext& context,
                                              const std::function<void(double)>& progress, double timeoutSeconds,
                                              const Deadline& deadline) {
  std::optional<TemporaryFolder> folder;
  if (isInline(request.output) || isInline(request.picture)) folder.emplace();
  const CommandLine line =
      commandLineOf(request, settings_.session, settings_.files, folder ? folder->path().string() : std::string());
  MeshSettings settings = meshSettingsOf(line);
  settings.timeoutSeconds = timeoutSeconds;
  const std::string path = request.mesh.empty() ? "" : inputPath(request.mesh, settings_.files);
  // Without a path, the mesh cannot be an output.
  const InputFile input{.path = path.empty() ? "-" : path};
  const std::string output = planOutputs(line.outputs, {}, {&input, 1}).front();
  LoadedMesh loaded = requestedMesh(request, path, line.reading, settings_.maxMemoryBytes);
  MeshRun run;
  sessions_.call(context.worker, settings.computation.options, deadline.token(), [&](Session& session) {
    run =
        computeMesh(session, line.meshes.front(), output, std::move(loaded), settings, deadline, {.receive = progress});
    return !run.failure || run.failure->code != ExitCode::Device;
  });

  MeshAnswer answer;
  if (run.failure) answer.failure = requestFailure(*run.failure);
  if (!run.hasResult) return answer;
  answer.report = run.json;
  answer.report.pop_back();  // The line end.
  if (folder) {
    Json report = Json::parse(answer.report);
    if (isInline(request.output)) {
      answer.output = answeredFile(output);
      report["output"] = nullptr;
    }
    if (isInline(request.picture)) {
      answer.picture = answeredFile(line.outputs.picture);
      report["picture"] = nullptr;
    }
    answer.report = jsonText(report);
  }
  if (settings_.describesInText && run.report) answer.rows = rowsWithRemedies(*run.report);
  return answer;
}

}  // namespace asdfvk
