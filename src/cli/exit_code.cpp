#include "cli/exit_code.h"

#include <fmt/core.h>

#include <algorithm>
#include <new>
#include <string_view>
#include <system_error>

#include "core/error_kind.h"
#include "core/text.h"
#include "describe/remedies.h"

namespace asdfvk {
namespace {

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
    return {exitCodeOf(error.kind()), oneLine(messageWithRemedy(error, requiresGpu, valueOptions)),
            nameOf(error.code())};
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
