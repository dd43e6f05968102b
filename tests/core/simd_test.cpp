#include "core/simd.h"

#include <doctest/doctest.h>

using namespace asdfvk;

TEST_CASE("broadcast gives every lane the number, on every instruction set") {
  for (const InstructionSet set : {InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512}) {
    if (!hasInstructionSet(set)) continue;
    const int missingCount = dispatch<Float16>(set, []<typename Floats>() ASDFVK_ALWAYS_INLINE {
      const Floats floats = broadcast<Floats>(2.5f);
      const IntsOf<Floats> ints = broadcast<IntsOf<Floats>>(-7);
      int count = 0;
      for (size_t lane = 0; lane < kLaneCount<Floats>; ++lane)
        count += floats[lane] == 2.5f && ints[lane] == -7 ? 1 : 0;
      return static_cast<int>(kLaneCount<Floats>) - count;
    });
    CHECK(missingCount == 0);
  }
  const Double4 doubles = broadcast<Double4>(0.1);
  for (size_t lane = 0; lane < kLaneCount<Double4>; ++lane) CHECK(doubles[lane] == 0.1);
}
