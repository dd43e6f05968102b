#pragma once

#include <sys/types.h>

#include <cstdint>

namespace asdfvk {

/// Highest resident memory of this process since the last reset, or since its start; bytes. 0 where it is unknown.
[[nodiscard]] uint64_t peakMemoryBytes();
void resetPeakMemory();

/// Resident memory of a process; 0 where it is unknown.
[[nodiscard]] uint64_t residentBytesOf(pid_t process);

}  // namespace asdfvk
