#pragma once

#include <cstdint>
#include <vector>

#include "mesh/components.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// The nesting of the closed components: which components are cavities, and of which bodies.
struct Nesting {
  std::vector<uint8_t> isCavity;  ///< #components
  /// #components. For a cavity: the innermost body around the cavity. For any other component: its own index.
  std::vector<uint32_t> bodyOf;
  std::vector<uint32_t> parentOf;  ///< #components: the innermost component around each, its own index if none.
};

/// Finds the cavities among the closed components. Component A is in component B if all samples of A
/// (component_samples.h) are in B; a component that touches or crosses B is therefore not in B. A component is a cavity
/// if the innermost component around it is a body. A component that also touches or crosses other components is a
/// cavity only if its faces are wound inwards. A sample is in B if a ray from it crosses an odd number of the faces of
/// B; computed in double. Time: about n log c for n faces and c components. The time is longer if many components are
/// nested, or if many long faces cross many components.
[[nodiscard]] Nesting findCavities(const TriangleMesh& mesh, const Components& components);

}  // namespace asdfvk
