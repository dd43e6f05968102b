#include "poisson/energy_rows.h"

namespace asdfvk {

SecondOrderRows::SecondOrderRows(const WeightedGraph& graph, double beta)
    : graph_(graph), diagonal_(graph.graph.faceCount(), 0.0), root_(graph.graph.faceCount(), 0.0) {
  forEachInParallel(diagonal_.size(), [&](size_t face) {
    uint32_t neighbourCount = 0;
    graph.visitNeighbours(static_cast<uint32_t>(face), [&](uint32_t, double weight) {
      diagonal_[face] += weight;
      ++neighbourCount;
    });
    if (neighbourCount > 0 && neighbourCount <= kMaxBendingNeighbourCount)
      root_[face] = std::sqrt(beta) / std::sqrt(diagonal_[face]);
  });
}

// In ascending order of faces, which makes the sums of a row those of its mirror image to the bit.
template <typename Visit>
void SecondOrderRows::visitLaplacianRow(uint32_t face, const Visit& visit) const {
  bool isDiagonalDue = true;
  graph_.visitNeighbours(face, [&](uint32_t neighbour, double weight) {
    if (isDiagonalDue && neighbour > face) {
      visit(face, diagonal_[face]);
      isDiagonalDue = false;
    }
    visit(neighbour, -weight);
  });
  if (isDiagonalDue) visit(face, diagonal_[face]);
}

void SecondOrderRows::gatherRow(uint32_t face, std::vector<Entry>& entries) const {
  entries.clear();
  uint32_t order = 0;
  visitLaplacianRow(face, [&](uint32_t g, double entry) { entries.push_back({g, order++, entry}); });
  visitLaplacianRow(face, [&](uint32_t g, double left) {
    if (root_[g] == 0) return;
    // Each factor with its root: the products of weights alone could overflow in a small unit.
    visitLaplacianRow(g, [&](uint32_t h, double right) {
      entries.push_back({h, order++, (left * root_[g]) * (right * root_[g])});
    });
  });
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.face != b.face ? a.face < b.face : a.order < b.order; });
}

double SecondOrderRows::guidance(uint32_t face, std::span<const double> divergence) const {
  if (divergence.empty()) return 0;
  double sum = finiteOrZero(divergence, face);
  visitLaplacianRow(
      face, [&](uint32_t g, double entry) { sum += (entry * root_[g]) * (root_[g] * finiteOrZero(divergence, g)); });
  return sum;
}

}  // namespace asdfvk
