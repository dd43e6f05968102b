#include "support/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <thread>

namespace asdfvk::bench {
namespace {

// Precondition: there is at least one sample, and the samples are sorted.
double medianOfSorted(const std::vector<double>& sorted) {
  const size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

/// The text after the colon in the first line that begins with `key`; empty if there is none.
std::string valueIn(const std::string& file, std::string_view key) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    return line.substr(std::min(line.find_first_not_of(" \t", colon + 1), line.size()));
  }
  return {};
}

}  // namespace

Dispersion dispersionOf(std::vector<double> samples) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  Dispersion dispersion{medianOfSorted(samples), 0, samples.front(), samples.back()};
  for (double& sample : samples) sample = std::abs(sample - dispersion.median);
  std::sort(samples.begin(), samples.end());
  dispersion.deviation = medianOfSorted(samples);
  return dispersion;
}

Dispersion ratioOf(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) ratios.push_back(a[i] / b[i]);
  return dispersionOf(std::move(ratios));
}

std::string toText(const Dispersion& dispersion, int decimals) {
  return fmt::format("{:.{}f} ±{:.{}f}", dispersion.median, decimals, dispersion.deviation, decimals);
}

std::string toText(const std::optional<Dispersion>& dispersion, int decimals) {
  return dispersion ? toText(*dispersion, decimals) : "-";
}

Json toJson(const Dispersion& dispersion) {
  return {{"median", dispersion.median},
          {"deviation", dispersion.deviation},
          {"min", dispersion.min},
          {"max", dispersion.max}};
}

Json toJson(const std::optional<Dispersion>& dispersion) { return dispersion ? toJson(*dispersion) : Json(nullptr); }

std::string oneLine(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

Machine thisMachine() {
  Machine machine{valueIn("/proc/cpuinfo", "model name"), std::max(1u, std::thread::hardware_concurrency()), 0};
  if (machine.processor.empty()) machine.processor = "unknown processor";
  getloadavg(&machine.loadAverage, 1);
  return machine;
}

std::string toText(const Machine& machine) {
  return fmt::format("{}, {} threads, load average {:.1f}", machine.processor, machine.threads, machine.loadAverage);
}

double peakMemoryBytes(int process) {
  return std::strtod(valueIn(fmt::format("/proc/{}/status", process), "VmHWM").c_str(), nullptr) * 1024;
}

}  // namespace asdfvk::bench
