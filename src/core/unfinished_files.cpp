#include "core/unfinished_files.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>

namespace asdfvk {
namespace {

/// Names of the files that are being written, for a signal handler. A thread or a handler that replaces a name by null
/// owns the name. Therefore the handler never reads a freed name.
std::array<std::atomic<const char*>, 64> unfinished{};
static_assert(std::atomic<const char*>::is_always_lock_free);

}  // namespace

void UnfinishedFile::announce(const std::string& path) {
  path_ = std::make_unique<char[]>(path.size() + 1);
  std::memcpy(path_.get(), path.c_str(), path.size() + 1);
  for (std::atomic<const char*>& slot : unfinished) {
    const char* none = nullptr;
    if (slot.compare_exchange_strong(none, path_.get(), std::memory_order_release)) return;
  }
  path_.reset();
}

void UnfinishedFile::withdraw() noexcept {
  if (path_ == nullptr) return;
  for (std::atomic<const char*>& slot : unfinished) {
    const char* mine = path_.get();
    if (!slot.compare_exchange_strong(mine, nullptr, std::memory_order_acquire)) continue;
    path_.reset();
    return;
  }
  // The signal handler has taken the name and ends the process. The name is not freed, because the handler may still
  // read the name.
  (void)path_.release();
}

void removeUnfinishedFiles() noexcept {
  for (std::atomic<const char*>& slot : unfinished)
    if (const char* name = slot.exchange(nullptr, std::memory_order_acquire)) ::unlink(name);
}

}  // namespace asdfvk
