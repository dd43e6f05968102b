#include "core/lane_exp.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "core/random.h"

using namespace asdfvk;

namespace {

/// expOfNegative() of each number, compiled for the instruction set.
std::vector<double> exponentials(const std::vector<double>& numbers, InstructionSet instructionSet) {
  std::vector<double> results(numbers.size());
  dispatch<Float8>(instructionSet, [&]<typename Floats>() ASDFVK_ALWAYS_INLINE {
    for (size_t i = 0; i < numbers.size(); i += kLaneCount<Double4>)
      store(&results[i], expOfNegative(load<Double4>(&numbers[i])));
  });
  return results;
}

std::vector<double> negativeNumbers() {
  Random random(3);
  std::vector<double> numbers{-0.0, 0, -5e-324, -511.999, -1e-18, -0.5, -1, -0.00270760617406228636};
  while (numbers.size() < 40'000)
    numbers.push_back(-std::ldexp(random.real(), static_cast<int>(random.index(40)) - 30));
  return numbers;
}

}  // namespace

TEST_CASE("exp() in lanes is within a unit in the last place, with the same bits on every instruction set") {
  const std::vector<double> numbers = negativeNumbers();
  const std::vector<double> results = exponentials(numbers, InstructionSet::Baseline);
  for (size_t i = 0; i < numbers.size(); ++i)
    REQUIRE(std::abs(std::bit_cast<int64_t>(results[i]) - std::bit_cast<int64_t>(std::exp(numbers[i]))) <= 1);
  if (hasInstructionSet(InstructionSet::Avx2)) CHECK(exponentials(numbers, InstructionSet::Avx2) == results);
}

#if defined(__GLIBC__) && defined(__x86_64__)
TEST_CASE("exp() in lanes has the bits of the C library on processors with fused multiply-add") {
  if (!hasInstructionSet(InstructionSet::Avx2)) return;  // The C library has other bits there.
  const std::vector<double> numbers = negativeNumbers();
  const std::vector<double> results = exponentials(numbers, InstructionSet::Avx2);
  for (size_t i = 0; i < numbers.size(); ++i) {
    CAPTURE(numbers[i]);
    REQUIRE(results[i] == std::exp(numbers[i]));
  }
}
#endif
