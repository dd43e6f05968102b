// Ways to compute with the bytes and the bits of wide nodes: values of the specialization constant kNodeArithmetic.
// kMaskedBytes and kShiftedBytes give the same bits. kMantissaBytes has two more roundings (kWideBoxMargin).
#ifndef ASDFVK_NODE_ARITHMETIC_H
#define ASDFVK_NODE_ARITHMETIC_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace asdfvk {
using glsl::uint;
#endif

// CPU devices: vector instructions of x86 convert signed integers to floats, but neither count nor find bits.
const uint kMaskedBytes = 0u;
// AMD GPUs: one instruction converts any byte of a word to a float.
const uint kShiftedBytes = 1u;
// NVIDIA and Intel GPUs: conversions are slow, so that bytes become mantissas of floats.
const uint kMantissaBytes = 2u;

#ifdef __cplusplus
}  // namespace asdfvk
#endif

#endif
