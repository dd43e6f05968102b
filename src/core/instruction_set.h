#pragma once

namespace asdfvk {

/// What numbers side by side are computed with; the bits are the same.
enum class InstructionSet {
  Baseline,  ///< What the program was compiled for.
  Avx2,
};

/// The widest that this machine has.
[[nodiscard]] inline InstructionSet widestInstructionSet() {
#ifdef __x86_64__
  static const bool hasAvx2 = __builtin_cpu_supports("avx2");
  return hasAvx2 ? InstructionSet::Avx2 : InstructionSet::Baseline;
#else
  return InstructionSet::Baseline;
#endif
}

}  // namespace asdfvk
