#include "core/matrix_game.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace asdfvk {
namespace {

/// The tableau of: maximise the sum of p, with sum(p[row] * payoff[row][column]) <= 1 for each column and p >= 0. The
/// payoffs are made positive, so that p = 0 is a corner of the domain, and the domain is bounded.
class Tableau {
 public:
  Tableau(std::span<const double[kGameColumns]> payoffs, double shift, double scale) : rowCount_(payoffs.size()) {
    for (size_t c = 0; c < kGameColumns; ++c) {
      for (size_t r = 0; r < rowCount_; ++r) cells_[c][r] = (payoffs[r][c] + shift) / scale;
      cells_[c][kMaxGameRows + c] = cells_[c][kRight] = 1;
      basis_[c] = kMaxGameRows + c;
    }
    for (size_t r = 0; r < rowCount_; ++r) cells_[kGameColumns][r] = -1;
  }

  void solve() {
    constexpr int kMaxPivots = 32;
    for (int i = 0; i < kMaxPivots; ++i) {
      const double* costs = cells_[kGameColumns];
      const size_t entering = static_cast<size_t>(std::min_element(costs, costs + kRight) - costs);
      if (costs[entering] > -kRounding) return;
      size_t leaving = kGameColumns;
      double least = std::numeric_limits<double>::infinity();
      for (size_t c = 0; c < kGameColumns; ++c)
        if (cells_[c][entering] > kRounding && cells_[c][kRight] / cells_[c][entering] < least) {
          least = cells_[c][kRight] / cells_[c][entering];
          leaving = c;
        }
      if (leaving == kGameColumns) return;
      pivot(leaving, entering);
    }
  }

  [[nodiscard]] GameSolution solution() const {
    GameSolution result;
    double rowSum = 0, columnSum = 0;
    for (size_t c = 0; c < kGameColumns; ++c) {
      if (basis_[c] < kMaxGameRows) rowSum += result.rows[basis_[c]] = std::max(cells_[c][kRight], 0.0);
      columnSum += result.columns[c] = std::max(cells_[kGameColumns][kMaxGameRows + c], 0.0);
    }
    for (size_t r = 0; r < rowCount_; ++r) result.rows[r] /= rowSum;
    for (double& share : result.columns) share /= columnSum;
    return result;
  }

 private:
  static constexpr size_t kRight = kMaxGameRows + kGameColumns;  ///< The right sides.
  static constexpr double kRounding = 1e-12;

  void pivot(size_t leaving, size_t entering) {
    double* row = cells_[leaving];
    const double factor = 1 / row[entering];
    for (size_t i = 0; i <= kRight; ++i) row[i] *= factor;
    for (size_t other = 0; other <= kGameColumns; ++other) {
      const double share = cells_[other][entering];
      if (other == leaving || share == 0) continue;
      for (size_t i = 0; i <= kRight; ++i) cells_[other][i] -= share * row[i];
    }
    basis_[leaving] = entering;
  }

  size_t rowCount_;
  double cells_[kGameColumns + 1][kRight + 1] = {};  ///< A row per column of the game, and the costs.
  size_t basis_[kGameColumns] = {};
};

}  // namespace

GameSolution solveGame(std::span<const double[kGameColumns]> payoffs) {
  double least = payoffs[0][0], greatest = least;
  for (const double(&row)[kGameColumns] : payoffs)
    for (const double payoff : row) {
      least = std::min(least, payoff);
      greatest = std::max(greatest, payoff);
    }
  GameSolution result;
  const double range = greatest - least;
  if (range > 0) {
    Tableau tableau(payoffs, range - least, range);
    tableau.solve();
    result = tableau.solution();
  } else {
    result.rows[0] = 1;
    std::fill(result.columns, result.columns + kGameColumns, 1.0 / kGameColumns);
  }
  result.value = -std::numeric_limits<double>::infinity();
  for (size_t c = 0; c < kGameColumns; ++c) {
    double paid = 0;
    for (size_t r = 0; r < payoffs.size(); ++r) paid += result.rows[r] * payoffs[r][c];
    result.value = std::max(result.value, paid);
  }
  return result;
}

}  // namespace asdfvk
