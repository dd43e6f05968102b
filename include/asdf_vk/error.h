#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/api.h"

namespace asdfvk {

/// Classes of errors that a caller can act on. The command line maps them to exit codes.
enum class ErrorKind {
  Usage,      ///< An option is out of range or contradicts another.
  Input,      ///< A mesh cannot be read, or there is nothing to compute on.
  Device,     ///< No usable device, or the device was lost or is too small.
  Output,     ///< A result cannot be written.
  Cancelled,  ///< The caller requested a stop.
};

enum class ErrorCode {
  // Usage
  OptionOutOfRange,
  OptionConflict,
  UnknownName,      ///< No sampler, solver, backend, format or shape has this name.
  UnknownFormat,    ///< Neither an option nor the extension of the file names a format.
  UnknownField,     ///< The result has no field of that name.
  InvalidArgument,  ///< A pointer is null, or a handle is not one. C interface only.
  // Input
  UnreadableInput,  ///< The file cannot be opened or violates its format; the message contains line or byte.
  EmptyMesh,        ///< No faces in the mesh, or in the region of it.
  ArraySize,        ///< An array has a wrong size, or offsets do not ascend.
  ArrayType,        ///< The elements of an array have an unsupported type. Python module and C interface only.
  NonFiniteNumber,  ///< A NaN or an infinite number where only finite ones are allowed.
  IndexOutOfRange,  ///< A face refers to a vertex that does not exist.
  MeshTooLarge,     ///< More vertices, faces or connections than 32 bits can index.
  FarFromOrigin,    ///< Double precision does not resolve the mesh at its coordinates.
  InputTooLarge,    ///< Does not fit into memory.
  NoValues,         ///< No face has a value.
  TooFewValues,     ///< Fewer different values than clusters.
  ValueOutOfRange,  ///< A value per face that the caller passed is negative, infinite, missing or too large; or a
                    ///< value of a result does not fit into float32.
  // Device
  NoVulkanLoader,     ///< libvulkan.so.1 is not installed.
  NoVulkanDriver,     ///< No driver, or none that the loader can start.
  NoUsableDevice,     ///< Every device was rejected; the message contains the reasons.
  GpuRequired,        ///< A GPU was required and the backend runs on the CPU.
  NoDeviceForKernel,  ///< A kernel variant or solver of the device was requested from a backend without a device.
  KernelUnsupported,  ///< The device lacks a feature that the requested kernel needs.
  DeviceLimit,        ///< The mesh exceeds a limit of the device.
  EquationLimit,      ///< The Poisson equation exceeds a limit of the device; the CPU solvers have none.
  OutOfDeviceMemory,
  DeviceLost,
  ValidationFailed,  ///< The Vulkan validation layers reported a problem.
  VulkanFailed,      ///< Any other failure of a Vulkan call.
  ForkedProcess,     ///< Use in a process forked after the first use. Python module and C interface only.
  // Output
  OutputNotWritable,
  // Cancelled
  Cancelled,
};

[[nodiscard]] ASDFVK_API ErrorKind kindOf(ErrorCode code);
/// "deviceLost"
[[nodiscard]] ASDFVK_API const char* nameOf(ErrorCode code);

/// A value of an error by name, for example {"limit", "134217728"}.
struct ErrorDetail {
  std::string name, value;
};

/// A failure that the caller can act on. what() is one line with the reason; it names no option of the command line.
class ASDFVK_API Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message, std::vector<ErrorDetail> details = {})
      : std::runtime_error(message), code_(code), details_(std::move(details)) {}

  [[nodiscard]] ErrorCode code() const { return code_; }
  [[nodiscard]] ErrorKind kind() const { return kindOf(code_); }
  [[nodiscard]] const std::vector<ErrorDetail>& details() const { return details_; }

 private:
  ErrorCode code_;
  std::vector<ErrorDetail> details_;
};

}  // namespace asdfvk
