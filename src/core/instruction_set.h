#pragma once

namespace asdfvk {

/// What numbers side by side are computed with; the bits are the same. Who has one has those before it.
enum class InstructionSet {
  Baseline,  ///< What the program was compiled for.
  Avx2,
  Avx512,
};

/// Whether this machine has it; always true of Baseline.
[[nodiscard]] inline bool hasInstructionSet(InstructionSet instructionSet) {
  if (instructionSet == InstructionSet::Baseline) return true;
#ifdef __x86_64__
  static const bool hasAvx2 = __builtin_cpu_supports("avx2"), hasAvx512 = __builtin_cpu_supports("avx512f");
  return hasAvx2 && (instructionSet == InstructionSet::Avx2 || hasAvx512);
#else
  return false;
#endif
}

/// The widest that this machine has.
[[nodiscard]] inline InstructionSet widestInstructionSet() {
  for (const InstructionSet wide : {InstructionSet::Avx512, InstructionSet::Avx2})
    if (hasInstructionSet(wide)) return wide;
  return InstructionSet::Baseline;
}

}  // namespace asdfvk
