#pragma once

#include <atomic>
#include <cstdint>

namespace asdfvk {

/// Sets a flag that several threads may set at once. Reads it first, because writes of a flag that is already set would
/// move its cache line between the processors.
inline void raiseFlag(uint8_t& flag) {
  const std::atomic_ref atomic(flag);
  if (atomic.load(std::memory_order_relaxed) == 0) atomic.store(1, std::memory_order_relaxed);
}

}  // namespace asdfvk
