#pragma once

#include <doctest/doctest.h>

#include <string>

#include "asdf_vk/error.h"

namespace asdfvk::test {

/// The call throws Error of that code, with `part` in its message.
template <typename Call>
void requireFailure(const Call& call, ErrorCode code, const std::string& part = "") {
  try {
    call();
    FAIL_CHECK("no exception");
  } catch (const Error& error) {
    CAPTURE(error.what());
    CHECK(std::string(nameOf(error.code())) == nameOf(code));
    CHECK(std::string(error.what()).find(part) != std::string::npos);
  }
}

}  // namespace asdfvk::test
