#pragma once

#include <cstddef>

namespace asdfvk {

inline constexpr size_t kHugePageBytes = 2 << 20;

/// Asks the kernel for huge pages, for all multiples of kHugePageBytes that are within this memory. With huge pages
/// there is a page fault for each 2 MiB instead of each 4 KiB, and the processor finds addresses faster. Failures are
/// ignored, because they cost only speed.
void requestHugePages(void* memory, size_t byteCount);

}  // namespace asdfvk
