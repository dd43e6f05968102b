#pragma once

#include <array>
#include <string>
#include <utility>

#include "asdf_vk/error.h"
#include "asdf_vk/report.h"
#include "process/interrupt.h"

namespace asdfvk {

/// Exit status of the program: that of the first failure.
enum class ExitCode : int {
  Done = 0,
  Usage = 1,        ///< The command line is invalid.
  Input = 2,        ///< A mesh is unreadable, or there is nothing to compute on it.
  Device = 3,       ///< No device, or it was lost, and no fallback is allowed.
  Output = 4,       ///< A result or report cannot be written.
  CheckFailed = 5,  ///< --check found traced faces that disagree with the reference, or no traced face at all; or
                    ///< --fail-if-thinner could not be judged.
  TooThin = 6,      ///< --fail-if-thinner: a point of the surface is thinner.
  SomeFailed = 7,   ///< Some of several meshes could not be computed; the others are done.
  Limit = 8,        ///< A mesh exceeded --timeout or --memory-limit, or the system allows no further file or thread.
  Internal = 70,    ///< A defect of the program.
  Cancelled = kCancelledCode,  ///< SIGINT, SIGTERM or SIGHUP.
};

/// Meaning of each code, for the help and the man page.
inline constexpr std::array<std::pair<ExitCode, const char*>, 11> kExitCodes{
    {{ExitCode::Done, "done"},
     {ExitCode::Usage, "usage"},
     {ExitCode::Input, "input unreadable"},
     {ExitCode::Device, "no device or device lost"},
     {ExitCode::Output, "output not writable"},
     {ExitCode::CheckFailed, "a requested check failed, or could not be made"},
     {ExitCode::TooThin, "thinner than --fail-if-thinner"},
     {ExitCode::SomeFailed, "some of several meshes failed, the others are done"},
     {ExitCode::Limit, "beyond --timeout, --memory-limit, or a limit of the system on open files or threads"},
     {ExitCode::Internal, "internal error"},
     {ExitCode::Cancelled, "cancelled"}}};

inline constexpr const char* kExitCodeOfSeveralMeshes =
    "With several meshes, the others are computed after a failure. The code is 7 if some meshes have a result, also "
    "with codes 5 and 6, and others have none; else it is that of the first failure.";

[[nodiscard]] ExitCode exitCodeOf(ErrorKind kind);

/// Whether a mesh with this code has a result.
[[nodiscard]] bool hasResult(ExitCode ofMesh);

/// Exit code of several meshes from those of each.
class SharedExitCode {
 public:
  void add(ExitCode ofMesh);
  [[nodiscard]] ExitCode code() const;

 private:
  ExitCode first_ = ExitCode::Done;
  bool hasResult_ = false, lacksResult_ = false, isCancelled_ = false;
};
/// Done or CheckFailed. A check that is not independent cannot fail.
[[nodiscard]] ExitCode exitCodeOf(const CheckReport& check);

/// Done, TooThin, or CheckFailed where a limit was not judged. Precondition: there is a limit.
[[nodiscard]] ExitCode exitCodeOf(const ThicknessReport& thickness);

/// A failure as it is reported.
struct Failure {
  ExitCode code = ExitCode::Internal;
  std::string message;            ///< One line: the reason, then the remedy.
  std::string name = "internal";  ///< nameOf(ErrorCode).
};

/// The failure of a mesh that took longer than --timeout.
[[nodiscard]] Failure timeLimitFailure(double timeoutSeconds);
/// The failure of a mesh that a stop request ended.
[[nodiscard]] Failure cancelledFailure();

/// Describes the exception being handled; to be called in a catch block. requiresGpu: do not propose the CPU.
/// valueOptions: options that need values, such as --segment.
[[nodiscard]] Failure currentFailure(bool requiresGpu = false, const std::string& valueOptions = "");

}  // namespace asdfvk
