#include "cli/exit_code.h"

#include <fmt/core.h>

#include <new>
#include <string_view>
#include <system_error>

#include "core/text.h"

namespace asdfvk {
namespace {

/// The remedy, such as an option or a package; empty if the reason suffices.
std::string remedyFor(ErrorCode code, bool requiresGpu, const std::string& valueOptions) {
  const auto orOnCpu = [&](const std::string& remedy) {
    return requiresGpu ? remedy : remedy + ", or use --backend cpu or reference";
  };
  switch (code) {
    case ErrorCode::UnknownField:
      return "an error estimate needs enough seeds, and faces that are not seeds; give a share such as --seeds 10%";
    case ErrorCode::NoValues:
      return "try --orient auto or flip" + (valueOptions.empty() ? "" : ", or drop " + valueOptions);
    case ErrorCode::TooFewValues:
      return "give fewer --clusters, or drop --segment";
    case ErrorCode::NoVulkanLoader:
      return orOnCpu("install libvulkan1");
    case ErrorCode::NoVulkanDriver:
      return requiresGpu ? "install the driver of the GPU, or drop --require-gpu"
                         : orOnCpu("install a driver (mesa-vulkan-drivers has one for any CPU)");
    case ErrorCode::NoUsableDevice:
      return "see --list-devices";
    case ErrorCode::GpuRequired:
      return "see --list-devices, or drop --require-gpu";
    case ErrorCode::NoDeviceForKernel:
      return "use --backend vulkan, or drop --solver, --kernel and --fetch";
    case ErrorCode::KernelUnsupported:
      return requiresGpu ? "use another --kernel" : "use another --kernel, or --backend reference";
    case ErrorCode::DeviceLimit:
      return orOnCpu("use --fetch auto, or a smaller mesh");
    case ErrorCode::OutOfDeviceMemory:
      return orOnCpu("use a smaller mesh");
    case ErrorCode::EquationLimit:
      return "use --solver cpu";
    case ErrorCode::DeviceLost:
      return orOnCpu("try again");
    case ErrorCode::MeshTooLarge:
      return "split the mesh";
    default:
      return "";
  }
}

std::string messageOf(const Error& error, bool requiresGpu, const std::string& valueOptions) {
  const std::string remedy = remedyFor(error.code(), requiresGpu, valueOptions);
  return remedy.empty() ? error.what() : std::string(error.what()) + "; " + remedy;
}

Failure limitFailure(const std::string& message) { return {ExitCode::Limit, message, "systemLimit"}; }

Failure fileLimitFailure() {
  return limitFailure("the system allows no further open file; raise its limit (ulimit -n), or give fewer --jobs");
}

Failure threadLimitFailure() {
  return limitFailure(
      "the system allows no further thread or process; raise its limit (ulimit -u, or the limit of the container), or "
      "give "
      "fewer --threads and --jobs");
}

Failure internalFailure(const char* reason) {
  return {ExitCode::Internal, oneLine(fmt::format("internal error: {}; please report it", reason))};
}

}  // namespace

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

bool hasResult(ExitCode ofMesh) {
  return ofMesh == ExitCode::Done || ofMesh == ExitCode::CheckFailed || ofMesh == ExitCode::TooThin;
}

void SharedExitCode::add(ExitCode ofMesh) {
  if (first_ == ExitCode::Done) first_ = ofMesh;
  if (ofMesh == ExitCode::Cancelled) isCancelled_ = true;
  (hasResult(ofMesh) ? hasResult_ : lacksResult_) = true;
}

ExitCode SharedExitCode::code() const {
  if (isCancelled_) return ExitCode::Cancelled;
  return hasResult_ && lacksResult_ ? ExitCode::SomeFailed : first_;
}

ExitCode exitCodeOf(const CheckReport& check) { return check.passed == false ? ExitCode::CheckFailed : ExitCode::Done; }

ExitCode exitCodeOf(const ThicknessReport& thickness) {
  if (thickness.verdict == ThicknessVerdict::Passed) return ExitCode::Done;
  return thickness.verdict == ThicknessVerdict::Failed ? ExitCode::TooThin : ExitCode::CheckFailed;
}

Failure timeLimitFailure(double timeoutSeconds) {
  return {ExitCode::Limit, fmt::format("took longer than --timeout {:g}", timeoutSeconds), "timeLimit"};
}

Failure cancelledFailure() { return {ExitCode::Cancelled, "cancelled", nameOf(ErrorCode::Cancelled)}; }

Failure currentFailure(bool requiresGpu, const std::string& valueOptions) {
  try {
    throw;
  } catch (const Error& error) {
    return {exitCodeOf(error.kind()), oneLine(messageOf(error, requiresGpu, valueOptions)), nameOf(error.code())};
  } catch (const std::bad_alloc&) {
    return {ExitCode::Input, "not enough memory for this mesh; use a machine with more memory or a coarser mesh",
            nameOf(ErrorCode::InputTooLarge)};
  } catch (const std::system_error& error) {
    const std::error_code& code = error.code();
    if (code == std::errc::too_many_files_open || code == std::errc::too_many_files_open_in_system)
      return fileLimitFailure();
    return code == std::errc::resource_unavailable_try_again ? threadLimitFailure() : internalFailure(error.what());
  } catch (const std::exception& error) {
    // TBB throws a std::runtime_error if it cannot start a thread.
    return std::string_view(error.what()).starts_with("pthread_create ") ? threadLimitFailure()
                                                                         : internalFailure(error.what());
  } catch (...) {
    return internalFailure("unknown");
  }
}

}  // namespace asdfvk
