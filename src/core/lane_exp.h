#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/simd.h"

/// exp() of vectors, with the bits of exp() of glibc 2.28 and later on processors with fused multiply-add. Source: S.
/// Nagy, ARM Optimized Routines (MIT license), math/exp.c, with a table of 128 entries and degree 5.
namespace asdfvk {

/// Row i of the table: 2^(i/128) is approximately (1 + tail) times the double with the bits `bits` + i 2^45.
struct PowerOfTwo {
  double tail;
  uint64_t bits;
};
using PowersOfTwo = std::array<PowerOfTwo, 128>;

/// Computes the table with twice the digits of a double, as products of repeated square roots of 2.
[[nodiscard]] inline PowersOfTwo computePowersOfTwo() {
  PowersOfTwo powers;
  for (uint32_t i = 0; i < powers.size(); ++i) {
    double high = 1, low = 0, rootHigh = 2, rootLow = 0;
    for (uint32_t bit = 64; bit > 0; bit /= 2) {
      const double root = std::sqrt(rootHigh);
      rootLow = (std::fma(-root, root, rootHigh) + rootLow) / (2 * root);
      rootHigh = root;
      if ((i & bit) == 0) continue;
      const double product = high * rootHigh;
      low = std::fma(high, rootHigh, -product) + (high * rootLow + low * rootHigh);
      high = product + low;
      low -= high - product;
    }
    powers[i].tail = low / high;
    std::memcpy(&powers[i].bits, &high, sizeof high);
    powers[i].bits -= uint64_t{i} << 45;
  }
  return powers;
}

inline const PowersOfTwo kPowersOfTwo = computePowersOfTwo();

/// Whether __builtin_fma() compiles to one instruction in code that dispatch() calls with Floats.
template <typename Floats>
[[nodiscard]] constexpr bool hasFusedMultiplyAdd() {
#ifdef __FP_FAST_FMA
  return true;
#else
  return kLaneCount<Floats> > kLaneCount<Float4>;
#endif
}

template <typename Doubles>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline Doubles fusedMultiplyAdd(const Doubles& a, const Doubles& b,
                                                                   const Doubles& c) {
  Doubles sum;
  for (size_t lane = 0; lane < kLaneCount<Doubles>; ++lane) sum[lane] = __builtin_fma(a[lane], b[lane], c[lane]);
  return sum;
}

/// exp(x) for -512 < x <= 0. Fast only on instruction sets with fused multiply-add: there, a loop of std::exp() takes 9
/// % more CPU seconds of a whole run (horse, 10 % seeds, `--segment cgal`).
template <typename Doubles>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline Doubles expOfNegative(const Doubles& x) {
  constexpr size_t kCount = kLaneCount<Doubles>;
  const auto fma = [](const Doubles& a, const Doubles& b, const Doubles& c)
                       ASDFVK_ALWAYS_INLINE { return fusedMultiplyAdd(a, b, c); };
  const auto all = [](double number) ASDFVK_ALWAYS_INLINE { return broadcast<Doubles>(number); };
  constexpr double kShift = 0x1.8p52;  // Adding kShift rounds to a whole number, in the lowest bits of the sum.
  const Doubles shifted = fma(x, all(0x1.71547652b82fep0 * 128), all(kShift));
  const Doubles whole = shifted - kShift;
  const Doubles r = fma(whole, all(-0x1.cf79abc9e3b3ap-47), fma(whole, all(-0x1.62e42fefa0000p-8), x));
  Doubles tail, power;
  for (size_t lane = 0; lane < kCount; ++lane) {
    uint64_t bits;
    const double number = shifted[lane];
    std::memcpy(&bits, &number, sizeof bits);
    const PowerOfTwo& entry = kPowersOfTwo[bits % kPowersOfTwo.size()];
    tail[lane] = entry.tail;
    bits = entry.bits + (bits << 45);
    double scale;
    std::memcpy(&scale, &bits, sizeof scale);
    power[lane] = scale;
  }
  const Doubles square = r * r;
  const Doubles low = fma(square, fma(r, all(0x1.555555555543cp-3), all(0x1.ffffffffffdbdp-2)), tail + r);
  const Doubles high = fma(r, all(0x1.1111167a4d017p-7), all(0x1.55555cf172b91p-5));
  return fma(power, fma(square * square, high, low), power);
}

}  // namespace asdfvk
