#include "generate/lattice_size.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace asdfvk {

// The number of crossed edges is proportional to 1 / spacing^2, more exactly on finer lattices.
BrickLattice latticeOfSize(const CapsuleUnion& field, uint64_t quadCount) {
  const auto wished = static_cast<double>(quadCount);
  double spacing = field.bounds().diagonal() / 20;
  std::optional<BrickLattice> best;
  double bestError = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < 16 && bestError > 0.02; ++attempt) {
    BrickLattice lattice(field, spacing);
    const double ratio = double(lattice.crossedEdgeCount()) / wished;
    const double error = std::abs(std::log(ratio));
    if (error < bestError) {
      bestError = error;
      best.emplace(std::move(lattice));
    }
    // The number of quads of coarse lattices changes in jumps: shorter steps find counts between them.
    const double power = attempt < 6 ? 0.5 : 0.2;
    spacing *= std::pow(std::clamp(ratio, 1.0 / 64, 64.0), power);
  }
  return std::move(*best);
}

}  // namespace asdfvk
