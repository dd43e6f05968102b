#pragma once

#include <array>
#include <set>
#include <string>
#include <utility>

#include "asdf_vk/error.h"
#include "asdf_vk/report.h"
#include "process/interrupt.h"

namespace asdfvk {

/// Exit status of the program. If a mesh has several failures, the first one determines the code; for several meshes
/// see SharedExitCode.
enum class ExitCode : int {
  Done = 0,
  Usage = 1,   ///< The command line is invalid.
  Input = 2,   ///< A mesh is unreadable, invalid or too large, or no value can be computed.
  Device = 3,  ///< There is no usable device or the device was lost, and no fallback is allowed.
  Output = 4,  ///< A result or report cannot be written.
  CheckFailed =
      5,          ///< --check failed or had no traced face to compare; or a limit of --fail-if-... could not be judged.
  OverLimit = 6,  ///< Thinner, thicker or closer than --fail-if-..., a sealed void or bodies in contact.
  SomeFailed = 7,  ///< Some of several meshes failed; the others are done.
  Limit = 8,       ///< A mesh exceeded --timeout or --memory-limit, or the system allows no further file or thread.
  Internal = 70,   ///< A defect of the program.
  Cancelled = kCancelledCode,  ///< SIGINT, SIGTERM or SIGHUP ended the run.
};

inline constexpr std::array<std::pair<ExitCode, const char*>, 11> kExitCodes{
    {{ExitCode::Done, "done"},
     {ExitCode::Usage, "invalid command line"},
     {ExitCode::Input, "input unreadable"},
     {ExitCode::Device, "no device or device lost"},
     {ExitCode::Output, "output not writable"},
     {ExitCode::CheckFailed, "a requested check failed or was not possible"},
     {ExitCode::OverLimit,
      "thinner, thicker or closer than a limit of --fail-if-..., a sealed void or bodies in contact"},
     {ExitCode::SomeFailed, "some of several meshes failed, the others are done"},
     {ExitCode::Limit,
      "a mesh exceeded --timeout or --memory-limit, or the system allows no further open file or thread"},
     {ExitCode::Internal, "internal error"},
     {ExitCode::Cancelled, "cancelled"}}};

inline constexpr const char* kExitCodeOfSeveralMeshes =
    "With several meshes, a failure does not end the run. The code does not depend on their order: 6 if a mesh has "
    "this "
    "code, else 7 if some meshes have a result and others have none, else 70, 3, 4, 8, 2 or 1 if none has a result, "
    "else "
    "5. The summary counts all.";

[[nodiscard]] ExitCode exitCodeOf(ErrorKind kind);

[[nodiscard]] bool hasResult(ExitCode ofMesh);

/// The exit code for several meshes, in any order: kExitCodeOfSeveralMeshes.
class SharedExitCode {
 public:
  void add(ExitCode ofMesh) { codes_.insert(ofMesh); }
  [[nodiscard]] ExitCode code() const;

 private:
  std::set<ExitCode> codes_;
};
/// Returns CheckFailed if the check failed, else Done. A check that is not CheckReport::independent cannot fail.
[[nodiscard]] ExitCode exitCodeOf(const CheckReport& check);

struct Failure {
  ExitCode code = ExitCode::Internal;
  std::string message;            ///< The reason and the remedy, in one line.
  std::string name = "internal";  ///< nameOf(ErrorCode), or another name such as "internal" or "timeLimit".
};

[[nodiscard]] Failure timeLimitFailure(double timeoutSeconds);
[[nodiscard]] Failure cancelledFailure();

/// Describes the current exception. Precondition: called in a catch block. requiresGpu: the remedy must not propose the
/// CPU. valueOptions: the given options that need shape diameters, such as --segment, for the remedy.
[[nodiscard]] Failure currentFailure(bool requiresGpu = false, const std::string& valueOptions = "");

}  // namespace asdfvk
