#include "asdf_vk/error.h"
#include "core/no_vulkan.h"
#include "diagnose/device_report.h"

namespace asdfvk {

DeviceReport reportDevice(const SessionOptions&, const RunControl&, double) {
  throw Error(ErrorCode::NoUsableDevice, kNoVulkan);
}

}  // namespace asdfvk
