#include "core/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace asdfvk {

void requestHugePages(void* memory, size_t byteCount) {
  constexpr uintptr_t kMask = kHugePageBytes - 1;
  const auto address = reinterpret_cast<uintptr_t>(memory);
  const uintptr_t begin = (address + kMask) & ~kMask, end = (address + byteCount) & ~kMask;
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace asdfvk
