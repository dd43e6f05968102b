#pragma once

#include <cstddef>
#include <span>

namespace asdfvk {

/// The most strategies of the row player, and the number of those of the column player.
inline constexpr size_t kMaxGameRows = 6, kGameColumns = 8;

/// Mixed strategies of a matrix game: the row player pays payoffs[row][column], and mixes rows to pay little.
struct GameSolution {
  double value = 0;  ///< The most that the row player pays with `rows`: a bound of the game's value from above.
  double rows[kMaxGameRows] = {};     ///< Not negative; the sum is 1.
  double columns[kGameColumns] = {};  ///< Not negative; the sum is 1.
};

/// Solves the game by the simplex method. payoffs: 1 to kMaxGameRows rows. If rounding ends the method early, `value`
/// is still a bound.
[[nodiscard]] GameSolution solveGame(std::span<const double[kGameColumns]> payoffs);

}  // namespace asdfvk
