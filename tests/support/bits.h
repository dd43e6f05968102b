#pragma once

#include <cstring>

namespace asdfvk::test {

/// Also true for equal NaNs, false for 0 and -0.
template <typename Vector>
bool haveSameBits(const Vector& a, const Vector& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

}  // namespace asdfvk::test
