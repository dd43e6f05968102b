#pragma once

#include <string>

namespace asdfvk::bench {

/// What times depend on and what a reader of them has to know.
struct Machine {
  std::string processor;
  unsigned threads = 1;    ///< That this process may run on at once.
  double loadAverage = 0;  ///< Of the last minute: times mean little where it exceeds what the benchmark itself causes.
};

[[nodiscard]] Machine thisMachine();

/// One line.
[[nodiscard]] std::string toText(const Machine& machine);

/// The most memory that this process has held at once, in bytes: VmHWM, shared libraries and mapped files included.
[[nodiscard]] double peakMemoryBytes();

}  // namespace asdfvk::bench
