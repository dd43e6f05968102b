// Built in place of the other embree_* files where there is no Embree.
#include "asdf_vk/error.h"
#include "trace/cone_tracer.h"
#include "trace/sight_tracer.h"

namespace asdfvk {
namespace {

[[noreturn]] void fail() { throw Error(ErrorCode::NoEmbree, "the library was built without Embree"); }

}  // namespace

bool hasEmbree() { return false; }

std::string embreeName() { fail(); }

std::unique_ptr<ConeTracer> makeEmbreeTracer(const TraceScene&, const Cone&) { fail(); }

std::unique_ptr<SightTracer> makeEmbreeSightTracer(const TraceScene&) { fail(); }

}  // namespace asdfvk
