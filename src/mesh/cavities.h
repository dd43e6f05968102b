#pragma once

#include <cstdint>
#include <vector>

#include "mesh/components.h"
#include "mesh/mesh.h"

namespace asdfvk {

/// Which closed components are cavities, and of which bodies.
struct Nesting {
  std::vector<uint8_t> isCavity;  ///< #components
  /// #components: of a cavity the innermost body around it; of any other component its own index.
  std::vector<uint32_t> bodyOf;
};

/// Finds the cavities among the closed components. A component is in another one if all of its samples
/// (component_samples.h) are; so a component that touches or crosses another one is not in it. A component is a cavity
/// if the innermost component around it is a body. If the component also touches or crosses others, its winding decides
/// instead: it is a cavity if it is wound inwards. A sample is in a component if a ray from the sample crosses an odd
/// number of the component's faces; computed in double. Time: about n log c for n faces and c components; more where
/// many components are nested, or many long faces cross many components.
[[nodiscard]] Nesting findCavities(const TriangleMesh& mesh, const Components& components);

}  // namespace asdfvk
