#include "predict/cone_kernel_lanes.h"

namespace asdfvk {

const ConeKernel& baselineConeKernel() { return kKernelInLanes; }

}  // namespace asdfvk
