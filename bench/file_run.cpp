#include "file_run.h"

#include <fmt/format.h>

#include "core/stopwatch.h"
#include "io/mesh_reader.h"
#include "io/result_writer.h"

namespace asdfvk::bench {

FileRun runFile(Session& session, const std::filesystem::path& path, const Options& options,
                const std::filesystem::path& output, const RunControl& control) {
  const Stopwatch whole;
  Mesh mesh = readMesh(path);
  const double readSeconds = whole.seconds();
  Result result = session.compute(mesh, options, control);
  const Stopwatch writing;
  writeResult(output, mesh, {result.sdf, result.isSeed});
  result.report.stageSeconds.write = writing.seconds();
  result.report.stageSeconds.read = readSeconds;
  return {std::move(result.report), whole.seconds()};
}

SessionOptions sessionOptionsOf(const std::string& backend, const std::string& device) {
  if (backend == "reference") return {.backend = Backend::Reference, .device = {}, .requireGpu = false};
  if (backend == "vulkan") return {.backend = Backend::Vulkan, .device = device, .requireGpu = false};
  if (backend == "cpu") return {.backend = Backend::Cpu, .device = {}, .requireGpu = false};
  throw Error(ErrorCode::UnknownName, fmt::format("'{}' is not a backend; give vulkan, cpu or reference", backend));
}

}  // namespace asdfvk::bench
