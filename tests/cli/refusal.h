#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "asdf_vk/error.h"
#include "cli/command_line.h"

namespace asdfvk {

/// The message of the usage error, or "accepted".
inline std::string refusal(const std::vector<std::string>& arguments) {
  try {
    (void)parseCommandLine(arguments);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::Usage);
    CHECK_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "accepted";
}

}  // namespace asdfvk
