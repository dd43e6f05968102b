#include "io/meshopt_view.h"

#include <fmt/core.h>
#include <meshoptimizer.h>

#include "io/input_failure.h"

namespace asdfvk {
namespace {

/// Whether the layout fulfils the preconditions of meshoptimizer, which it only asserts.
bool isMeshoptLayout(const MeshoptView& view) {
  if (view.mode != MeshoptMode::Attributes)
    return (view.stride == 2 || view.stride == 4) && view.filter == MeshoptFilter::None &&
           (view.mode == MeshoptMode::Indices || view.count % 3 == 0);
  if (view.stride % 4 != 0) return false;
  if (view.filter == MeshoptFilter::Octahedral) return view.stride == 4 || view.stride == 8;
  return view.filter != MeshoptFilter::Quaternion || view.stride == 8;
}

}  // namespace

bool readsMeshopt() { return true; }

std::vector<char> decodeMeshopt(std::span<const char> bytes, const MeshoptView& view, std::string_view where) {
  if (!isMeshoptLayout(view))
    failInput(fmt::format("{} is compressed by meshopt, and its mode or filter does not allow {} elements of {} bytes",
                          where, view.count, view.stride));
  std::vector<char> decoded(view.count * view.stride);
  const auto* const from = reinterpret_cast<const unsigned char*>(bytes.data());
  const int result = view.mode == MeshoptMode::Attributes
                         ? meshopt_decodeVertexBuffer(decoded.data(), view.count, view.stride, from, bytes.size())
                     : view.mode == MeshoptMode::Triangles
                         ? meshopt_decodeIndexBuffer(decoded.data(), view.count, view.stride, from, bytes.size())
                         : meshopt_decodeIndexSequence(decoded.data(), view.count, view.stride, from, bytes.size());
  if (result != 0)
    failInput(fmt::format("{} is compressed by meshopt, and its data is damaged, or of a later version (error {})",
                          where, result));
  if (view.filter == MeshoptFilter::Octahedral) meshopt_decodeFilterOct(decoded.data(), view.count, view.stride);
  if (view.filter == MeshoptFilter::Quaternion) meshopt_decodeFilterQuat(decoded.data(), view.count, view.stride);
  if (view.filter == MeshoptFilter::Exponential) meshopt_decodeFilterExp(decoded.data(), view.count, view.stride);
  return decoded;
}

}  // namespace asdfvk
