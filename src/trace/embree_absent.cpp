// Built in place of the other embree_* files where there is no Embree.
#include "asdf_vk/error.h"
#include "trace/cone_tracer.h"

namespace asdfvk {

bool hasEmbree() { return false; }

void requireEmbree() { throw Error(ErrorCode::NoEmbree, "the library was built without Embree"); }

std::string embreeName() { return {}; }

std::unique_ptr<ConeTracer> makeEmbreeTracer(const TraceScene&, const Cone&) {
  requireEmbree();
  return {};
}

}  // namespace asdfvk
