#pragma once

#include <cstdint>
#include <vector>

#include "mesh/components.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// How closed components lie in each other.
struct Nesting {
  std::vector<uint8_t> isCavity;  ///< #components
  std::vector<uint32_t> bodyOf;   ///< #components: of a cavity the innermost body around it, of others themselves.
};

/// A closed component is a cavity if the innermost other one that it is in is a body. It is in another one if all of
/// its samples are (component_samples.h): a component that touches or crosses another one is not in it. Where a
/// component touches or crosses others and is in a further one, its winding decides: inwards is a cavity. The parity of
/// the faces that a ray crosses, in double, decides what a sample is in. Time: about n log c for n faces and c
/// components; more where many components are nested, or many long faces cross many components.
[[nodiscard]] Nesting findCavities(const TriangleMesh& mesh, const Components& components);

}  // namespace asdfvk
