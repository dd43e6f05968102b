#include "cli/exit_code.h"

#include <fmt/core.h>

#include <algorithm>
#include <new>
#include <string_view>
#include <system_error>

#include "core/error_kind.h"
#include "core/text.h"

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

std::string messageOf(const Error& error, bool requiresGpu, const std::string& valueOptions) {
  std::string message = error.what();
  for (const Remedy& remedy : kRemedies) {
    if (remedy.code != error.code()) continue;
    message += fmt::format("; {}", requiresGpu ? remedy.ifGpuRequired : remedy.text);
    if (remedy.isCpuPossible && !requiresGpu) message += ", or use --backend cpu or reference";
    if (remedy.code == ErrorCode::NoValues && !valueOptions.empty()) message += ", or drop " + valueOptions;
  }
  return message;
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

ExitCode exitCodeOf(ErrorKind kind) { return static_cast<ExitCode>(rowOf(kind).code); }

bool hasResult(ExitCode ofMesh) {
  return ofMesh == ExitCode::Done || ofMesh == ExitCode::CheckFailed || ofMesh == ExitCode::OverLimit;
}

ExitCode SharedExitCode::code() const {
  for (const ExitCode first : {ExitCode::Cancelled, ExitCode::OverLimit})
    if (codes_.contains(first)) return first;
  const auto withResult = std::count_if(codes_.begin(), codes_.end(), hasResult);
  if (withResult == 0)
    for (const ExitCode next :
         {ExitCode::Internal, ExitCode::Device, ExitCode::Output, ExitCode::Limit, ExitCode::Input, ExitCode::Usage})
      if (codes_.contains(next)) return next;
  if (static_cast<size_t>(withResult) < codes_.size()) return ExitCode::SomeFailed;
  return codes_.contains(ExitCode::CheckFailed) ? ExitCode::CheckFailed : ExitCode::Done;
}

ExitCode exitCodeOf(const CheckReport& check) { return check.passed == false ? ExitCode::CheckFailed : ExitCode::Done; }

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
