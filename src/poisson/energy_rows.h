#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "poisson/weighted_graph.h"

namespace asdfvk {

/// The rows of L, the graph's Laplacian: of the energy sum_{f,g} w_fg (u_f - u_g)^2.
struct FirstOrderRows {
  const WeightedGraph& graph;

  /// Calls visit(face, entry) for each entry of the row that may not be 0, each once.
  template <typename Visit>
  void visitRow(uint32_t face, const Visit& visit) const {
    double diagonal = 0;
    graph.visitNeighbours(face, [&](uint32_t neighbour, double weight) {
      diagonal += weight;
      visit(neighbour, -weight);
    });
    visit(face, diagonal);
  }

  /// What the divergence (#F) of a guidance field puts on the right-hand side.
  [[nodiscard]] double guidance(uint32_t face, std::span<const double> divergence) const {
    return finiteOrZero(divergence, face);
  }
};

/// A face with more neighbours than this, of which there are none on a manifold mesh, does not bend: its row of L
/// would tie each of them to each other one. It keeps the entries below (kMaxBendingNeighbourCount + 1)^2 per face.
inline constexpr uint32_t kMaxBendingNeighbourCount = 8;

/// The rows of L + beta L D^-1 L, D the diagonal of L: of the energy above plus beta sum_f (L u)_f^2 / D_f over the
/// faces that bend. Guidance by a divergence d becomes (I + beta L D^-1) d, so that a field u solves the equation for
/// d = L u here as in FirstOrderRows.
class SecondOrderRows {
 public:
  /// beta > 0. The graph must outlive this.
  SecondOrderRows(const WeightedGraph& graph, double beta);

  template <typename Visit>
  void visitRow(uint32_t face, const Visit& visit) const {
    thread_local std::vector<Entry> entries;
    gatherRow(face, entries);
    for (size_t i = 0; i < entries.size();) {
      const uint32_t column = entries[i].face;
      double sum = 0;
      for (; i < entries.size() && entries[i].face == column; ++i) sum += entries[i].value;
      visit(column, sum);
    }
  }

  [[nodiscard]] double guidance(uint32_t face, std::span<const double> divergence) const;

 private:
  struct Entry {
    uint32_t face, order;
    double value;
  };

  template <typename Visit>
  void visitLaplacianRow(uint32_t face, const Visit& visit) const;
  void gatherRow(uint32_t face, std::vector<Entry>& entries) const;

  const WeightedGraph& graph_;
  std::vector<double> diagonal_;  ///< #F, D.
  std::vector<double> root_;      ///< #F, sqrt(beta / D_f), 0 for a face that does not bend.
};

}  // namespace asdfvk
