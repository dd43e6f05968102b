#pragma once

#include <cstddef>
#include <span>

#include "shared/cone_hit.h"

namespace asdfvk {

/// Hits in the memory of the device that traced them (ConeTracer::makeDeviceHits()), for predictions on this device.
class DeviceHits {
 public:
  virtual ~DeviceHits() = default;
  /// Makes room for the hits of `coneCount` cones, earlier ones included. Throws Error of kind Device, also where the
  /// device has too little memory; the earlier hits remain.
  virtual void reserve(size_t coneCount) = 0;
  /// Copies all hits to the host, in the order of the cones. Throws Error of kind Device.
  virtual void download(std::span<ConeHit> hits) const = 0;
};

}  // namespace asdfvk
