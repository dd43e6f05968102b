// Built in place of bare_embree.cpp where there is no Embree.
#include "bare_embree.h"

namespace asdfvk::bench {

std::unique_ptr<BareEmbree> makeBareEmbree(const TraceScene&, std::span<const uint32_t>, const Cone&, BareMode) {
  return {};
}

}  // namespace asdfvk::bench
