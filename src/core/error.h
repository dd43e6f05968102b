#pragma once

#include <stdexcept>
#include <string>

namespace asdfvk {

/// What went wrong, in the classes that a caller can act on. The command line maps them to exit codes.
enum class ErrorKind {
  Usage,      ///< An option has no meaning or contradicts another.
  Input,      ///< A mesh cannot be read or holds nothing to compute on.
  Device,     ///< No usable Vulkan device, or the device was lost or too small.
  Output,     ///< A result cannot be written.
  Cancelled,  ///< The caller asked to stop.
};

/// A failure the user can act on: what() is one line with the reason and, where there is one, the remedy.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace asdfvk
