// Built in place of the embree_* files where there is no Embree.
#include "core/error.h"
#include "trace/embree_tracer.h"

namespace asdfvk {

bool hasEmbree() { return false; }

std::string embreeName() { return {}; }

std::unique_ptr<ConeTracer> makeEmbreeTracer(const TraceScene&, const Cone&) {
  throw Error(ErrorKind::Device,
              "this build has no Embree; install libembree-dev and build again, or use --backend vulkan or reference");
}

}  // namespace asdfvk
