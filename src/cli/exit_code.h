#pragma once

#include <string>

#include "asdf_vk/error.h"
#include "pipeline/asdf.h"

namespace asdfvk {

/// What the program ends with. Of several failures the first one counts.
enum class ExitCode : int {
  Done = 0,
  Usage = 1,        ///< The command line has no meaning.
  Input = 2,        ///< A mesh is unreadable, or there is nothing to compute on it.
  Device = 3,       ///< No device, or it was lost, and no fallback is allowed.
  Output = 4,       ///< A result or report cannot be written.
  CheckFailed = 5,  ///< --check found traced faces that disagree with the reference, or no traced face at all.
  Internal = 70,    ///< A mistake in the program.
  Cancelled = 130,  ///< SIGINT, SIGTERM or SIGHUP.
};

[[nodiscard]] ExitCode exitCodeOf(ErrorKind kind);

/// Done or CheckFailed. A check that is not independent has nothing to fail.
[[nodiscard]] ExitCode exitCodeOf(const CheckReport& check);

/// A failure as the user meets it: message is one line.
struct Failure {
  ExitCode code = ExitCode::Internal;
  std::string message;
};

/// Describes the exception being handled; to be called in a catch block.
[[nodiscard]] Failure currentFailure();

/// The same text with every control character replaced by a space, so that a message stays one line whatever the names
/// in it.
[[nodiscard]] std::string oneLine(std::string text);

}  // namespace asdfvk
