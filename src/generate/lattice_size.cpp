#include "generate/lattice_size.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace asdfvk {

// The number of crossed edges goes with 1 / spacing^2, ever more exactly so as the lattice gets finer.
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
    // Coarse lattices gain and lose quads in jumps: shorter steps find a way between two of them.
    const double power = attempt < 6 ? 0.5 : 0.2;
    spacing *= std::pow(std::clamp(ratio, 1.0 / 64, 64.0), power);
  }
  return std::move(*best);
}

}  // namespace asdfvk
