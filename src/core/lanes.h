#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef __AVX512F__
#include <immintrin.h>
#endif

/// Sixteen floats computed side by side, in vectors as wide as the instructions are that a file is compiled for (vector
/// extensions of GCC and Clang): compilers leave loops with comparisons in them to one float at a time. Lanes
/// do the same operations whatever the width, and are added up in the same order: the same bits.
///
/// A file compiled for other instructions than the rest of the program may call nothing that another file could be
/// linked with instead: everything here is always inlined, and named after the width.
#if defined(__AVX512F__)
#define ASDFVK_LANE_WIDTH 16
#define ASDFVK_LANE_NAMESPACE lanesBy16
#elif defined(__AVX2__)
#define ASDFVK_LANE_WIDTH 8
#define ASDFVK_LANE_NAMESPACE lanesBy8
#else
#define ASDFVK_LANE_WIDTH 4
#define ASDFVK_LANE_NAMESPACE lanesBy4
#endif
#define ASDFVK_LANES [[gnu::always_inline]] inline

namespace asdfvk {

inline constexpr size_t kLaneCount = 16;

inline namespace ASDFVK_LANE_NAMESPACE {

/// Of a part of the lanes, which is one vector of the machine.
constexpr size_t kLaneWidth = ASDFVK_LANE_WIDTH;

using Floats = float __attribute__((vector_size(kLaneWidth * sizeof(float))));
using Integers = int32_t __attribute__((vector_size(kLaneWidth * sizeof(int32_t))));
#ifdef __AVX512F__
using LaneMask = __mmask16;
#else
using LaneMask = Integers;  ///< All bits of a lane set or none.
#endif

/// numbers: kLaneWidth of them.
template <typename Part, typename Number>
ASDFVK_LANES Part loaded(const Number* numbers) {
  static_assert(sizeof(Part) == kLaneWidth * sizeof(Number));
  Part part;
  std::memcpy(&part, numbers, sizeof part);
  return part;
}
ASDFVK_LANES void store(float* numbers, Floats part) { std::memcpy(numbers, &part, sizeof part); }

#ifdef __AVX512F__
ASDFVK_LANES LaneMask isAtMost(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
ASDFVK_LANES LaneMask isOther(Integers a, Integers b) {
  return _mm512_cmpneq_epi32_mask(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b));
}
ASDFVK_LANES Floats whereTrue(LaneMask mask, Floats a) { return _mm512_maskz_mov_ps(mask, a); }
ASDFVK_LANES Floats lesser(Floats a, Floats b) { return _mm512_maskz_min_ps(0xffff, a, b); }
ASDFVK_LANES Floats greater(Floats a, Floats b) { return _mm512_maskz_max_ps(0xffff, a, b); }
#else
/// Not where one is NaN.
ASDFVK_LANES LaneMask isAtMost(Floats a, Floats b) { return a <= b; }
ASDFVK_LANES LaneMask isOther(Integers a, Integers b) { return a != b; }
/// 0 elsewhere, also for NaN.
ASDFVK_LANES Floats whereTrue(LaneMask mask, Floats a) {
  return reinterpret_cast<Floats>(mask & reinterpret_cast<LaneMask>(a));
}
/// b where one is NaN.
ASDFVK_LANES Floats lesser(Floats a, Floats b) { return a < b ? a : b; }
ASDFVK_LANES Floats greater(Floats a, Floats b) { return a > b ? a : b; }
#endif

/// 1 / sqrt(x) to a relative error of 1e-3 for positive x (the bits halved, then one Newton step with constants
/// that balance its error). A large number for 0.
ASDFVK_LANES Floats roughInverseRoot(Floats x) {
  const Integers bits = 0x5f376a40 - (reinterpret_cast<Integers>(x) >> 1);
  const Floats y = reinterpret_cast<Floats>(bits);
  return y * (1.500881f - 0.5f * x * y * y);
}

/// The same to 1e-6.
ASDFVK_LANES Floats inverseRoot(Floats x) {
  const Floats y = roughInverseRoot(x);
  return y * (1.5000006f - 0.5f * x * y * y);
}

/// e^-x to a relative error of 1e-4, for x from 0 to 80.
ASDFVK_LANES Floats decay(Floats x) {
  const Floats power = 127.0f - x * 1.44269504f;  // Above 11: truncation is rounding down.
  const Integers whole = __builtin_convertvector(power, Integers);
  const Floats rest = power - __builtin_convertvector(whole, Floats);
  const Floats ofRest = 0.99992522f + rest * (0.695833507f + rest * (0.226067254f + rest * 0.0780244537f));
  return ofRest * reinterpret_cast<Floats>(whole << 23);
}

/// Sums kLaneCount numbers in all lanes, whatever the width: each lane by itself, then pairs eight lanes apart, four,
/// two and one.
class LaneSum {
 public:
  /// lane: of the first of `part`.
  ASDFVK_LANES void add(size_t lane, Floats part) { parts_[lane / kLaneWidth] += part; }

  [[nodiscard]] ASDFVK_LANES float total() const {
    using Four = float __attribute__((vector_size(4 * sizeof(float))));
#if ASDFVK_LANE_WIDTH == 16
    const auto eight = __builtin_shufflevector(parts_[0], parts_[0], 0, 1, 2, 3, 4, 5, 6, 7) +
                       __builtin_shufflevector(parts_[0], parts_[0], 8, 9, 10, 11, 12, 13, 14, 15);
    const Four four =
        __builtin_shufflevector(eight, eight, 0, 1, 2, 3) + __builtin_shufflevector(eight, eight, 4, 5, 6, 7);
#elif ASDFVK_LANE_WIDTH == 8
    const auto eight = parts_[0] + parts_[1];
    const Four four =
        __builtin_shufflevector(eight, eight, 0, 1, 2, 3) + __builtin_shufflevector(eight, eight, 4, 5, 6, 7);
#else
    const Four four = (parts_[0] + parts_[2]) + (parts_[1] + parts_[3]);
#endif
    const Four two = four + __builtin_shufflevector(four, four, 2, 3, 2, 3);
    return two[0] + two[1];
  }

 private:
  Floats parts_[kLaneCount / kLaneWidth] = {};
};

}  // namespace ASDFVK_LANE_NAMESPACE
}  // namespace asdfvk
