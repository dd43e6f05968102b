#include "machine.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <thread>

namespace asdfvk::bench {
namespace {

/// What follows the colon in the first line that begins with `key`; empty when there is none.
std::string valueIn(const char* file, std::string_view key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    return line.substr(std::min(line.find_first_not_of(" \t", colon + 1), line.size()));
  }
  return {};
}

}  // namespace

Machine thisMachine() {
  Machine machine{valueIn("/proc/cpuinfo", "model name"), std::max(1u, std::thread::hardware_concurrency()), 0};
  if (machine.processor.empty()) machine.processor = "unknown processor";
  getloadavg(&machine.loadAverage, 1);
  return machine;
}

std::string toText(const Machine& machine) {
  return fmt::format("{}, {} threads, load average {:.1f}", machine.processor, machine.threads, machine.loadAverage);
}

double peakMemoryBytes() { return std::strtod(valueIn("/proc/self/status", "VmHWM").c_str(), nullptr) * 1024; }

}  // namespace asdfvk::bench
