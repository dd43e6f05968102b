#include "cli/exit_code.h"

#include <new>

namespace asdfvk {

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
    return {exitCodeOf(error.kind()), oneLine(error.what())};
  } catch (const std::bad_alloc&) {
    return {ExitCode::Input, "not enough memory for this mesh; use a machine with more memory or a coarser mesh"};
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
