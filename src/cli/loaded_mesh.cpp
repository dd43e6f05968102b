#include "cli/loaded_mesh.h"

#include <chrono>
#include <filesystem>
#include <future>
#include <optional>
#include <span>
#include <thread>
#include <utility>

#include "asdf_vk/error.h"
#include "batch/content_hash.h"
#include "core/stopwatch.h"
#include "io/files.h"
#include "io/formats.h"

namespace asdfvk {
namespace {

constexpr auto kReadPollTime = std::chrono::milliseconds(20);

LoadedMesh loadNow(const std::string& path, const ReadOptions& options, bool computesHash) {
  LoadedMesh loaded;
  const Stopwatch watch;
  std::optional<ContentHash> hash;
  try {
    loaded.mesh = readMesh(path, options, [&](std::span<const char> bytes) {
      if (!computesHash) return;
      if (!hash) hash.emplace();
      hash->add(bytes);
    });
  } catch (...) {
    loaded.failure = std::current_exception();
  }
  if (hash) loaded.hash = hash->text();
  loaded.seconds = watch.seconds();
  return loaded;
}

}  // namespace

LoadedMesh loadMember(const std::string& name, const std::string& bytes, ReadOptions options, bool computesHash) {
  LoadedMesh loaded;
  const Stopwatch watch;
  if (computesHash) loaded.hash = contentHash(bytes);
  options.format = meshExtension(name);
  try {
    loaded.mesh = parseMesh(bytes, options);
  } catch (...) {
    loaded.failure = std::current_exception();
  }
  loaded.seconds = watch.seconds();
  return loaded;
}

bool mayWait(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return path == "-" || (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status));
}

LoadedMesh loadMesh(const std::string& path, const ReadOptions& options, bool computesHash,
                    const std::stop_token& stop) {
  if (!mayWait(path)) return loadNow(path, options, computesHash);
  try {
    std::packaged_task<LoadedMesh()> task(
        [path, options, computesHash] { return loadNow(path, options, computesHash); });
    std::future<LoadedMesh> loaded = task.get_future();
    std::thread(std::move(task)).detach();  // The thread may be blocked in a system call until the process ends.
    while (loaded.wait_for(kReadPollTime) != std::future_status::ready)
      if (stop.stop_requested()) throw Error(ErrorCode::Cancelled, "cancelled");
    return loaded.get();
  } catch (...) {
    return {.failure = std::current_exception()};
  }
}

}  // namespace asdfvk
