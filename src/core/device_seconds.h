#pragma once

namespace asdfvk {

/// Time of a device, by its own clock.
struct DeviceSeconds {
  double kernels = 0, copies = 0;

  DeviceSeconds& operator+=(const DeviceSeconds& other) {
    kernels += other.kernels;
    copies += other.copies;
    return *this;
  }
};

}  // namespace asdfvk
