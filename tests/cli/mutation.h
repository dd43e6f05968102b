#pragma once

#include <string>

#include "core/random.h"

namespace asdfvk::test {

/// A copy of a file's bytes with one fault, sometimes two: flipped bits, a cut, a doubled or missing part, a number
/// replaced by an extreme one, in its text or as four raw bytes.
[[nodiscard]] std::string mutate(std::string bytes, Random& random);

}  // namespace asdfvk::test
