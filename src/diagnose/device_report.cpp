#include "diagnose/device_report.h"

#include <algorithm>

namespace asdfvk {

const TracerReport* DeviceReport::fastest() const {
  const TracerReport* best = nullptr;
  for (const TracerReport& tracer : tracers)
    if (tracer.variant && tracer.passed && (best == nullptr || tracer.raysPerSecond > best->raysPerSecond))
      best = &tracer;
  return best;
}

bool DeviceReport::passed() const {
  const auto isRight = [](const auto& report) { return report.passed || !report.refusal.empty(); };
  const bool defaultPassed = std::any_of(tracers.begin(), tracers.end(), [&](const TracerReport& tracer) {
    return tracer.passed && (tracer.isDefault || !device);
  });
  return !failure && defaultPassed && std::all_of(tracers.begin(), tracers.end(), isRight) &&
         std::all_of(solvers.begin(), solvers.end(), isRight);
}

}  // namespace asdfvk
