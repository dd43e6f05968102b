#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

/// Vectors of numbers, by the vector extensions of GCC and Clang, and code compiled for several instruction sets.
///
/// Operators are element-wise and round like the scalar operators: results have the same bits on every instruction set.
/// Compilers split a vector that is wider than the registers.
///
/// dispatch() calls code for several instruction sets. In this code, functions that take or return vectors are always
/// inlined. Such functions are compiled for the instruction set of the caller, and need no calling convention. A
/// definition must precede its callers, because GCC ignores the attribute in any other order.
#define ASDFVK_ALWAYS_INLINE __attribute__((always_inline))

namespace asdfvk {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Float16 = float __attribute__((vector_size(64)));
using Double4 = double __attribute__((vector_size(32)));

/// The vector of signed integers with the lane count and size of V. In a mask, -1 is true and 0 is false.
template <typename V>
using IntsOf = decltype(V{} == V{});

template <typename V>
using NumberOf = std::remove_cvref_t<decltype(V{}[0])>;

template <typename V>
inline constexpr size_t kLaneCount = sizeof(V) / sizeof(NumberOf<V>);

/// Reads kLaneCount<V> numbers, at any alignment.
template <typename V, typename Number>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline V load(const Number* numbers) {
  static_assert(sizeof(Number) == sizeof(NumberOf<V>));
  V vector;
  std::memcpy(&vector, numbers, sizeof vector);
  return vector;
}

/// Writes kLaneCount<V> numbers, at any alignment. Number must have the size of the elements, but may be a different
/// type: the elements of a mask of doubles are long with GCC and long long with Clang.
template <typename V, typename Number>
ASDFVK_ALWAYS_INLINE inline void store(Number* numbers, const V& vector) {
  static_assert(sizeof(Number) == sizeof(NumberOf<V>));
  std::memcpy(numbers, &vector, sizeof vector);
}

/// A vector with `number` in every lane. Uses a shuffle, because GCC 12 compiles `number - V{}` for 64-byte vectors
/// element by element.
template <typename V>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline V broadcast(NumberOf<V> number) {
  V first{};
  first[0] = number;
  return [&]<size_t... kLane>(std::index_sequence<kLane...>) ASDFVK_ALWAYS_INLINE {
    return __builtin_shufflevector(first, first, (kLane * 0)...);
  }
  (std::make_index_sequence<kLaneCount<V>>());
}

/// The minimum per lane; takes the lane of b if both are equal or one is NaN.
template <typename V>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline V min(const V& a, const V& b) {
  return a < b ? a : b;
}

/// The maximum per lane; takes the lane of b if both are equal or one is NaN.
template <typename V>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline V max(const V& a, const V& b) {
  return a > b ? a : b;
}

/// The mask of the lanes where a <= b. lessEqual(), notEqual() and select() exist because GCC 12 compiles the operators
/// for 64-byte masks element by element.
template <typename V>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline IntsOf<V> lessEqual(const V& a, const V& b) {
  if constexpr (sizeof(V) < 64)
    return a <= b;
  else
    return reinterpret_cast<IntsOf<V>>(a <= b ? reinterpret_cast<V>(IntsOf<V>{} - 1) : V{});
}

template <typename V>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline IntsOf<V> notEqual(const V& a, const V& b) {
  if constexpr (sizeof(V) < 64)
    return a != b;
  else
    return reinterpret_cast<IntsOf<V>>(a != b ? reinterpret_cast<V>(IntsOf<V>{} - 1) : V{});
}

/// The lanes of a where the mask is true, 0 in the other lanes.
template <typename V>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline V select(const IntsOf<V>& mask, const V& a) {
  return reinterpret_cast<V>(mask & reinterpret_cast<IntsOf<V>>(a));
}

/// The bitwise or of all 64-bit words. With 32-bit lanes, the upper half of the result belongs to the odd lanes.
template <typename Ints>
ASDFVK_ALWAYS_INLINE inline uint64_t orLanes(const Ints& lanes) {
  if constexpr (sizeof(Ints) > 16) {
    using Half = std::conditional_t<sizeof(Ints) == 64, IntsOf<Float8>, IntsOf<Float4>>;
    std::array<Half, 2> halves;
    std::memcpy(halves.data(), &lanes, sizeof lanes);
    return orLanes<Half>(halves[0] | halves[1]);
  } else {
    std::array<uint64_t, 2> words;
    std::memcpy(words.data(), &lanes, sizeof lanes);
    return words[0] | words[1];
  }
}

template <typename Mask>
ASDFVK_ALWAYS_INLINE inline bool anyLane(const Mask& mask) {
  return orLanes(mask) != 0;
}

/// Bit i of the result is set where lane i of the mask is true.
template <typename Mask>
ASDFVK_ALWAYS_INLINE inline uint32_t bitsOf(const Mask& mask) {
  Mask bits;
  for (size_t lane = 0; lane < kLaneCount<Mask>; ++lane) bits[lane] = 1 << lane;
  const uint64_t both = orLanes<Mask>(mask & bits);
  return static_cast<uint32_t>(both | both >> 32);
}

/// 1 / sqrt(x).
template <typename Floats>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline Floats rsqrt(const Floats& x) {
  Floats root;
  for (size_t lane = 0; lane < kLaneCount<Floats>; ++lane) root[lane] = __builtin_sqrtf(x[lane]);
  return 1 / root;
}

/// exp(-x) with a relative error of 1e-4, for x from 0 to 80. In the prediction, a loop of std::exp() takes 6 % more
/// CPU seconds of a whole run (horse, 10 % seeds).
template <typename Floats>
[[nodiscard]] ASDFVK_ALWAYS_INLINE inline Floats expNegative(const Floats& x) {
  const Floats exponent = 127.0f - x * 1.44269504f;  // The bias makes the sum positive: truncation rounds down.
  const auto whole = __builtin_convertvector(exponent, IntsOf<Floats>);
  const Floats rest = exponent - __builtin_convertvector(whole, Floats);
  const Floats powerOfRest = 0.99992522f + rest * (0.695833507f + rest * (0.226067254f + rest * 0.0780244537f));
  return powerOfRest * reinterpret_cast<Floats>(whole << 23);
}

/// The instruction sets of dispatch(), ascending: a machine with an instruction set has all earlier ones.
enum class InstructionSet {
  Baseline,  ///< The instruction set for which the program is compiled.
  Avx2,      ///< AVX2 with fused multiply-add, which only __builtin_fma() uses.
  Avx512,
};

[[nodiscard]] inline bool hasInstructionSet(InstructionSet instructionSet) {
  if (instructionSet == InstructionSet::Baseline) return true;
#ifdef __x86_64__
  static const bool hasAvx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"),
                    hasAvx512 = __builtin_cpu_supports("avx512f");
  return hasAvx2 && (instructionSet == InstructionSet::Avx2 || hasAvx512);
#else
  return false;
#endif
}

[[nodiscard]] inline InstructionSet widestInstructionSet() {
  for (const InstructionSet wide : {InstructionSet::Avx512, InstructionSet::Avx2})
    if (hasInstructionSet(wide)) return wide;
  return InstructionSet::Baseline;
}

#ifdef __x86_64__
template <typename Code>
[[gnu::target("avx2,fma")]] auto runWithAvx2(const Code& code) {
  return code.template operator()<Float8>();
}
template <typename Code>
[[gnu::target("avx512f,fma")]] auto runWithAvx512(const Code& code) {
  return code.template operator()<Float16>();
}
#endif

/// Runs `code`, compiled for the instruction set, and returns its result. code: a lambda `[&]<typename Floats>()
/// ASDFVK_ALWAYS_INLINE { ... }`. Floats: the vector of floats that fills a register, at most Widest (Float8 or
/// Float16). Precondition: this machine has the instruction set.
template <typename Widest, typename Code>
auto dispatch([[maybe_unused]] InstructionSet instructionSet, const Code& code) {
#ifdef __x86_64__
  if constexpr (sizeof(Widest) == sizeof(Float16))
    if (instructionSet == InstructionSet::Avx512) return runWithAvx512(code);
  if (instructionSet >= InstructionSet::Avx2) return runWithAvx2(code);
#endif
  return code.template operator()<Float4>();
}

}  // namespace asdfvk
