#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace asdfvk {

enum class MeshoptMode { Attributes, Triangles, Indices };
enum class MeshoptFilter { None, Octahedral, Quaternion, Exponential };

/// The layout of a buffer view that is compressed by the extension EXT_meshopt_compression.
struct MeshoptView {
  MeshoptMode mode = MeshoptMode::Attributes;
  MeshoptFilter filter = MeshoptFilter::None;
  uint64_t count = 0, stride = 0;  ///< Elements, and bytes per element.
};

/// Whether this build has meshoptimizer.
[[nodiscard]] bool readsMeshopt();

/// Returns count * stride bytes. Precondition: stride is 1 to 256. Throws Error{UnreadableInput} for other impossible
/// layouts, for damaged bytes, and if this build has no meshoptimizer. The message begins with `where`.
[[nodiscard]] std::vector<char> decodeMeshopt(std::span<const char> bytes, const MeshoptView& view,
                                              std::string_view where);

}  // namespace asdfvk
