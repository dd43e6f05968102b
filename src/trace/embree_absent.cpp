// Built in place of the other embree_* files where there is no Embree.
#include "core/error.h"
#include "trace/embree/embree_tracer.h"

namespace asdfvk {

bool hasEmbree() { return false; }

void requireEmbree() {
  throw Error(ErrorKind::Device,
              "this program was built without Embree; install libembree-dev and build it again, or use another "
              "--backend");
}

std::string embreeName() { return {}; }

std::unique_ptr<ConeTracer> makeEmbreeTracer(const TraceScene&, const Cone&) {
  requireEmbree();
  return {};
}

}  // namespace asdfvk
