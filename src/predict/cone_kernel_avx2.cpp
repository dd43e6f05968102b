#include "predict/cone_kernel_lanes.h"

namespace asdfvk {

#ifdef __AVX2__
const ConeKernel& avx2ConeKernel() { return kKernelInLanes; }
#else
const ConeKernel& avx2ConeKernel() { return baselineConeKernel(); }
#endif

}  // namespace asdfvk
