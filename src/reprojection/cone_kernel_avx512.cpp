#include "reprojection/cone_kernel_lanes.h"

namespace asdfvk {

#ifdef __AVX512F__
const ConeKernel& avx512ConeKernel() {
  static constexpr ConeKernel kKernel{[](const ConeRules& rules, const ConeKernel::Seen& seen, const VirtualCone& at) {
                                        return coneValueInLanes(rules, seen, at);
                                      },
                                      [](const SeedGroup& seeds, const SeedReach& reach, const VirtualCone& at,
                                         float* weights) { weighInLanes(seeds, reach, at, weights); }};
  return kKernel;
}
#else
const ConeKernel& avx512ConeKernel() { return baselineConeKernel(); }
#endif

}  // namespace asdfvk
