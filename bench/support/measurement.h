#pragma once

#include <ctime>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/stopwatch.h"

namespace asdfvk::bench {

/// All members are 0 without samples. The median of an even number of samples is the mean of the two middle samples.
/// deviation: median absolute deviation.
struct Dispersion {
  double median = 0, deviation = 0, min = 0, max = 0;
};

[[nodiscard]] Dispersion dispersionOf(std::vector<double> samples);

/// The ratios a[i] / b[i], up to the end of the shorter list.
[[nodiscard]] Dispersion ratioOf(const std::vector<double>& a, const std::vector<double>& b);

/// Median and median absolute deviation as text, such as "0.123 ±0.004".
[[nodiscard]] std::string toText(const Dispersion& dispersion, int decimals);
/// "-" without a value.
[[nodiscard]] std::string toText(const std::optional<Dispersion>& dispersion, int decimals);

using Json = nlohmann::ordered_json;
[[nodiscard]] Json toJson(const Dispersion& dispersion);
/// JSON null if the value is unset.
[[nodiscard]] Json toJson(const std::optional<Dispersion>& dispersion);
/// The document as text with a final line feed. Invalid UTF-8 is replaced.
[[nodiscard]] std::string oneLine(const Json& json);

enum class Clock {
  ProcessCpu,  ///< CPU seconds of all threads of this process. Other load on the machine affects them less than elapsed
               ///< seconds.
  Wall,        ///< Elapsed seconds, for GPUs and for threads that wait for each other.
};

class Timer {
 public:
  explicit Timer(Clock clock) : clock_(clock) {}

  [[nodiscard]] double seconds() const {
    if (clock_ == Clock::Wall) return wall_.seconds();
    return static_cast<double>(std::clock() - cpuStart_) / CLOCKS_PER_SEC;
  }

 private:
  Clock clock_;
  std::clock_t cpuStart_ = std::clock();
  Stopwatch wall_;
};

struct Machine {
  std::string processor;
  unsigned threads = 1;    ///< Hardware threads.
  double loadAverage = 0;  ///< Load of the last minute, including the benchmark.
};

[[nodiscard]] Machine thisMachine();
[[nodiscard]] std::string toText(const Machine& machine);

/// Peak resident memory of a running process so far (VmHWM); 0 after its end.
[[nodiscard]] double peakMemoryBytes(int process);

}  // namespace asdfvk::bench
