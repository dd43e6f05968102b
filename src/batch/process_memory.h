#pragma once

#include <sys/types.h>

#include <cstdint>

namespace asdfvk {

/// Peak resident memory of this process in bytes, since the last resetPeakMemory() or its start; 0 if unknown.
[[nodiscard]] uint64_t peakMemoryBytes();
void resetPeakMemory();

/// Resident memory of a process in bytes; 0 if unknown.
[[nodiscard]] uint64_t residentBytesOf(pid_t process);

}  // namespace asdfvk
