#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/api.h"

namespace asdfvk {

/// Classes of errors that a caller can handle. The command line maps each class to an exit code.
enum class ErrorKind {
  Usage,      ///< An option is out of range or contradicts another.
  Input,      ///< A mesh or array is unreadable, invalid or too large, or no value can be computed.
  Device,     ///< No device is usable, or the device was lost or is too small.
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
  InvalidArgument,  ///< A pointer is null or a handle is invalid. C interface only.
  // Input
  UnreadableInput,  ///< The file cannot be opened or violates its format. The message names the line or byte.
  EmptyMesh,        ///< The mesh, or the given region of the mesh, has no faces.
  ArraySize,        ///< An array has a wrong size, or the entries of firstCorner do not ascend.
  ArrayType,        ///< The element type of an array is not supported. C interface and Python module only.
  NonFiniteNumber,  ///< A number is NaN or infinite where only finite numbers are allowed.
  IndexOutOfRange,  ///< A face refers to a vertex that does not exist.
  MeshTooLarge,     ///< The mesh has more vertices, faces or connections between faces than 32 bits can index.
  FarFromOrigin,    ///< The coordinates are so large that double precision does not resolve the mesh.
  InputTooLarge,    ///< The mesh does not fit into memory.
  TooManyFaces,     ///< The file has more faces than the reader allows (ReadOptions::maxFaces).
  NoValues,         ///< No face has a value.
  TooFewValues,     ///< There are fewer distinct values than clusters.
  ValueOutOfRange,  ///< A value per face from the caller is out of range, or a result does not fit into float32.
  UnitsDiffer,      ///< Meshes of one computation state different units.
  // Device
  NoVulkanLoader,     ///< libvulkan.so.1 is not installed.
  NoVulkanDriver,     ///< No driver is installed or can be loaded.
  NoUsableDevice,     ///< Every device was rejected; the message contains the reasons.
  GpuRequired,        ///< A GPU was required, but the backend runs on the CPU.
  NoDeviceForKernel,  ///< A kernel variant or a solver on the device was requested, but the backend has no device.
  KernelUnsupported,  ///< The device lacks a feature that the requested kernel needs.
  DeviceLimit,        ///< The mesh exceeds a limit of the device.
  EquationLimit,      ///< The Poisson equation exceeds a limit of the device. The CPU solvers have no limit.
  OutOfDeviceMemory,
  DeviceLost,
  ValidationFailed,  ///< The Vulkan validation layers reported a problem.
  VulkanFailed,      ///< A call of Vulkan failed for another reason.
  ForkedProcess,     ///< The process was forked after the first use. C interface and Python module only.
  // Output
  OutputNotWritable,
  // Cancelled
  Cancelled,
};

[[nodiscard]] ASDFVK_API ErrorKind kindOf(ErrorCode code);
/// The name of an enumerator with a small first letter, for example "deviceLost".
[[nodiscard]] ASDFVK_API const char* nameOf(ErrorCode code);

/// A named value of an error, for example {"limit", "134217728"}.
struct ErrorDetail {
  std::string name, value;
};

/// A failure that the caller can handle. what() is one line with the reason, without names of command-line options.
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
