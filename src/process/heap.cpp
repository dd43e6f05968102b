#include "process/heap.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>

#include "core/huge_pages.h"

// The address sanitizer checks its own operators.
#if defined(__SANITIZE_ADDRESS__)
#define ASDFVK_HAS_OWN_OPERATORS 0
#elif defined(__has_feature)
#define ASDFVK_HAS_OWN_OPERATORS !__has_feature(address_sanitizer)
#else
#define ASDFVK_HAS_OWN_OPERATORS 1
#endif

namespace asdfvk {

namespace {

// The heap grows by this size more than needed. Without this reserve, the heap would end directly after each large
// allocation, in the middle of a huge page, and the kernel would use small pages there. Only unused memory beyond this
// size is returned to the kernel.
constexpr int kReserveBytes = 256 << 20;
std::atomic<bool> hasReserve = false;

#if ASDFVK_HAS_OWN_OPERATORS
constexpr size_t kMinAdvisedBytes = 128 << 10;

// The heap has been advised up to this address. Each call locks the address space against the page faults of all
// threads, so that a call per allocation would cost time.
std::atomic<uintptr_t> advisedEnd = 0;

/// Requests huge pages from the first huge page of the memory to the last huge page of the memory or of the heap.
void adviseHugePages(void* memory, size_t byteCount) {
  if (byteCount < kMinAdvisedBytes) return;
  constexpr uintptr_t kMask = kHugePageBytes - 1;
  const auto heapEnd = reinterpret_cast<uintptr_t>(::sbrk(0)), begin = reinterpret_cast<uintptr_t>(memory),
             end = begin + byteCount;
  // The heap ends below the advised end after it has shrunk.
  if (end <= advisedEnd && advisedEnd <= heapEnd) return;
  const uintptr_t first = begin & ~kMask, last = std::max((end + kMask) & ~kMask, heapEnd & ~kMask);
  requestHugePages(reinterpret_cast<void*>(first), last - first);
  if (end <= heapEnd) advisedEnd = last;
}

/// Requests huge pages for the unused part of the heap, and lets this part begin at the boundary of a huge page. The
/// kernel maps no huge page where a small page is already mapped, as at the start of the heap.
void alignHeap() {
  constexpr size_t kByteCount = 2 * kMinAdvisedBytes;  // More than is free, so that the heap grows by the reserve.
  void* const memory = std::malloc(kByteCount);
  if (memory == nullptr) return;
  adviseHugePages(memory, kByteCount);
  const auto address = reinterpret_cast<uintptr_t>(memory);
  const size_t toBoundary = kHugePageBytes - (address + kByteCount) % kHugePageBytes;
  // Nothing uses this memory. A failure is ignored, because it costs only speed.
  [[maybe_unused]] void* const unused = std::realloc(memory, kByteCount + toBoundary);
}
#else
void alignHeap() {}
#endif

}  // namespace

void configureHeap() {
  hasReserve = true;
  ::mallopt(M_TOP_PAD, kReserveBytes);
  ::mallopt(M_MMAP_MAX, 0);
  ::mallopt(M_ARENA_MAX, 1);
  ::mallopt(M_TRIM_THRESHOLD, kReserveBytes);
  static std::once_flag isAligned;
  std::call_once(isAligned, alignHeap);
}

}  // namespace asdfvk

#if ASDFVK_HAS_OWN_OPERATORS
namespace asdfvk {
namespace {

/// There may be enough memory without a reserve, for example with `ulimit -v`. Only `new` tries this, not malloc().
template <typename Allocate>
void* allocatedWithoutReserve(const Allocate& allocate) {
  static std::mutex mutex;  // Otherwise another thread could restore the reserve before the allocation.
  const std::lock_guard lock(mutex);
  ::mallopt(M_TOP_PAD, 0);
  void* const memory = allocate();
  ::mallopt(M_TOP_PAD, kReserveBytes);
  return memory;
}

/// Calls the new-handler until `allocate` succeeds, as the standard requires of operator new.
template <typename Allocate>
void* allocated(size_t byteCount, const Allocate& allocate) {
  for (;;) {
    void* memory = allocate();
    if (memory == nullptr && hasReserve) memory = allocatedWithoutReserve(allocate);
    if (memory != nullptr) {
      adviseHugePages(memory, byteCount);
      return memory;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

}  // namespace
}  // namespace asdfvk

void* operator new(size_t byteCount) {
  return asdfvk::allocated(byteCount, [&] { return std::malloc(byteCount > 0 ? byteCount : 1); });
}

void* operator new(size_t byteCount, std::align_val_t alignment) {
  return asdfvk::allocated(byteCount, [&] {
    void* memory = nullptr;
    const size_t allowed = std::max(static_cast<size_t>(alignment), sizeof(void*));
    return ::posix_memalign(&memory, allowed, byteCount) == 0 ? memory : nullptr;
  });
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
#endif
