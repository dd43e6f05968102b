#include "describe/remedies.h"

#include <fmt/core.h>

#include <string_view>

namespace asdfvk {
namespace {

/// The remedy for an error, such as an option or a package.
struct Remedy {
  ErrorCode code;
  std::string_view text;
  std::string_view ifGpuRequired = text;
  bool isCpuPossible = false;  ///< Without --require-gpu, the CPU is a further remedy.
};
constexpr Remedy kRemedies[]{
    {ErrorCode::UnknownField,
     "an error estimate needs enough seeds, and faces that are not seeds; give a share such as --seeds 10%"},
    {ErrorCode::NoValues, "try --orient auto or flip"},
    {ErrorCode::TooFewValues, "give fewer --clusters, or drop --segment"},
    {ErrorCode::NoVulkanLoader, "install libvulkan1", "install libvulkan1", true},
    {ErrorCode::NoVulkanDriver, "install a driver (mesa-vulkan-drivers has one for any CPU)",
     "install the driver of the GPU, or drop --require-gpu", true},
    {ErrorCode::NoUsableDevice, "see --list-devices"},
    {ErrorCode::GpuRequired, "see --list-devices, or drop --require-gpu"},
    {ErrorCode::NoDeviceForKernel, "use --backend vulkan, or drop --solver, --kernel and --fetch"},
    {ErrorCode::KernelUnsupported, "use another --kernel, or --backend reference", "use another --kernel"},
    {ErrorCode::DeviceLimit, "use --fetch auto, or a smaller mesh", "use --fetch auto, or a smaller mesh", true},
    {ErrorCode::OutOfDeviceMemory, "use a smaller mesh", "use a smaller mesh", true},
    {ErrorCode::EquationLimit, "use --solver cpu"},
    {ErrorCode::DeviceLost, "try again", "try again", true},
    {ErrorCode::MeshTooLarge, "split the mesh"},
    {ErrorCode::TooManyFaces, "--max-faces N allows more"},
};

}  // namespace

std::string messageWithRemedy(const Error& error, bool requiresGpu, const std::string& valueOptions) {
  std::string message = error.what();
  for (const Remedy& remedy : kRemedies) {
    if (remedy.code != error.code()) continue;
    message += fmt::format("; {}", requiresGpu ? remedy.ifGpuRequired : remedy.text);
    if (remedy.isCpuPossible && !requiresGpu) message += ", or use --backend cpu or reference";
    if (remedy.code == ErrorCode::NoValues && !valueOptions.empty()) message += ", or drop " + valueOptions;
  }
  return message;
}

}  // namespace asdfvk
