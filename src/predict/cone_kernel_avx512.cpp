#include "predict/cone_kernel_lanes.h"

namespace asdfvk {

#ifdef __AVX512F__
const ConeKernel& avx512ConeKernel() { return kKernelInLanes; }
#else
const ConeKernel& avx512ConeKernel() { return baselineConeKernel(); }
#endif

}  // namespace asdfvk
