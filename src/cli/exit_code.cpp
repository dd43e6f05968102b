#include "cli/exit_code.h"

#include <new>

namespace asdfvk {
namespace {

/// The remedy in terms of options and packages, or empty where the reason suffices.
const char* remedyFor(ErrorCode code) {
  switch (code) {
    case ErrorCode::UnknownField:
      return "so few seeds allow no estimate; give more --seeds";
    case ErrorCode::NoVulkanLoader:
      return "install libvulkan1, or use --backend cpu or reference";
    case ErrorCode::NoVulkanDriver:
      return "install a driver (mesa-vulkan-drivers has one for any CPU), or use --backend cpu or reference";
    case ErrorCode::NoUsableDevice:
      return "see --list-devices";
    case ErrorCode::GpuRequired:
      return "see --list-devices, or drop --require-gpu";
    case ErrorCode::NoEmbree:
      return "use another --backend, or install libembree-dev and build again";
    case ErrorCode::EmbreeFailed:
      return "use --backend reference";
    case ErrorCode::NoDeviceForKernel:
      return "use --backend vulkan, or drop --solver, --kernel, --bvh and --fetch";
    case ErrorCode::KernelUnsupported:
      return "use another --kernel, or --backend reference";
    case ErrorCode::DeviceLimit:
    case ErrorCode::OutOfDeviceMemory:
      return "use a smaller mesh, or --backend cpu or reference";
    case ErrorCode::EquationLimit:
      return "use --solver cpu";
    case ErrorCode::DeviceLost:
    case ErrorCode::DeviceTimeout:
      return "try again, or use --backend cpu or reference";
    case ErrorCode::MeshTooLarge:
      return "split the mesh";
    default:
      return "";
  }
}

}  // namespace

std::string messageOf(const Error& error) {
  const std::string remedy = remedyFor(error.code());
  return remedy.empty() ? error.what() : std::string(error.what()) + "; " + remedy;
}

ExitCode exitCodeOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Usage:
      return ExitCode::Usage;
    case ErrorKind::Input:
      return ExitCode::Input;
    case ErrorKind::Device:
      return ExitCode::Device;
    case ErrorKind::Output:
      return ExitCode::Output;
    case ErrorKind::Cancelled:
      return ExitCode::Cancelled;
  }
  return ExitCode::Internal;
}

ExitCode exitCodeOf(const CheckReport& check) {
  return check.passed || !check.isIndependent ? ExitCode::Done : ExitCode::CheckFailed;
}

Failure currentFailure() {
  try {
    throw;
  } catch (const Error& error) {
    return {exitCodeOf(error.kind()), oneLine(messageOf(error)), nameOf(error.code())};
  } catch (const std::bad_alloc&) {
    return {ExitCode::Input, "not enough memory for this mesh; use a machine with more memory or a coarser mesh",
            nameOf(ErrorCode::InputTooLarge)};
  } catch (const std::exception& error) {
    return {ExitCode::Internal, oneLine(std::string("internal error: ") + error.what() + "; please report it")};
  } catch (...) {
    return {ExitCode::Internal, "internal error: unknown; please report it"};
  }
}

std::string oneLine(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

}  // namespace asdfvk
