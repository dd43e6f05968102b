#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seeds/seed_domain.h"

namespace asdfvk {

/// The faces in the order in which a depth-first search of the dual graph first comes to them. It begins at the lowest
/// face, takes the lowest neighbour first, and goes on with the lowest face not yet seen. Neighbours in it are mostly
/// neighbours on the surface, as along a ribbon wound around it.
[[nodiscard]] std::vector<uint32_t> depthFirstOrder(const DualGraph& graph);

/// Every n-th of the candidates in depth-first order, existing ones left out; n need not be whole, so that exactly
/// `count` come out or all that are left. The random seed decides where in the first n the first one is.
/// existing: faces already chosen, in any order. Ascending.
[[nodiscard]] std::vector<uint32_t> depthFirstSeeds(const SeedDomain& domain, uint64_t count,
                                                    std::span<const uint32_t> existing, uint64_t randomSeed);

}  // namespace asdfvk
