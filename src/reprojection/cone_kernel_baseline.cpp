#include "reprojection/cone_kernel_lanes.h"

namespace asdfvk {

const ConeKernel& baselineConeKernel() {
  static constexpr ConeKernel kKernel{[](const ConeRules& rules, const ConeKernel::Seen& seen, const VirtualCone& at) {
                                        return coneValueInLanes(rules, seen, at);
                                      },
                                      [](const SeedGroup& seeds, const SeedReach& reach, const VirtualCone& at,
                                         float* weights) { weighInLanes(seeds, reach, at, weights); }};
  return kKernel;
}

}  // namespace asdfvk
