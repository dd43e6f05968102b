#include "core/matrix_game.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/random.h"

using namespace asdfvk;

namespace {

struct Game {
  double payoffs[kMaxGameRows][kGameColumns] = {};
  size_t rowCount = 0;

  [[nodiscard]] GameSolution solve() const { return solveGame(std::span(payoffs).first(rowCount)); }
};

/// Checks that the strategies are mixtures, and returns the least payment that `columns` allows.
double paymentFor(const Game& game, const GameSolution& solution) {
  double rowSum = 0, columnSum = 0, greatest = -1e300, least = 1e300;
  for (size_t row = 0; row < kMaxGameRows; ++row) {
    CHECK(solution.rows[row] >= 0);
    if (row >= game.rowCount) CHECK(solution.rows[row] == 0);
    rowSum += solution.rows[row];
  }
  for (size_t column = 0; column < kGameColumns; ++column) {
    CHECK(solution.columns[column] >= 0);
    columnSum += solution.columns[column];
    double paid = 0;
    for (size_t row = 0; row < game.rowCount; ++row) paid += solution.rows[row] * game.payoffs[row][column];
    greatest = std::max(greatest, paid);
  }
  CHECK(rowSum == doctest::Approx(1));
  CHECK(columnSum == doctest::Approx(1));
  CHECK(solution.value == doctest::Approx(greatest));
  for (size_t row = 0; row < game.rowCount; ++row) {
    double paid = 0;
    for (size_t column = 0; column < kGameColumns; ++column)
      paid += solution.columns[column] * game.payoffs[row][column];
    least = std::min(least, paid);
  }
  return least;
}

}  // namespace

TEST_CASE("a game with one row has its greatest payoff as value") {
  Game game{.payoffs = {{1, 4, 2, 3, 0, -1, 2, 3}}, .rowCount = 1};
  CHECK(game.solve().value == 4);
  CHECK(game.solve().columns[1] == doctest::Approx(1));
  for (double& payoff : game.payoffs[0]) payoff = -2.5;
  CHECK(game.solve().value == -2.5);
}

TEST_CASE("rows that complement one another are mixed") {
  Game game{.rowCount = 3};
  for (size_t column = 0; column < kGameColumns; ++column) {
    game.payoffs[0][column] = column & 1 ? 3 : -1;
    game.payoffs[1][column] = column & 1 ? -1 : 3;
    game.payoffs[2][column] = 2;
  }
  const GameSolution solution = game.solve();
  CHECK(solution.value == doctest::Approx(1));
  CHECK(solution.rows[0] == doctest::Approx(0.5));
  CHECK(solution.rows[2] == 0);
}

TEST_CASE("the strategies of both players allow the same payment, also where payoffs are equal or large") {
  Random random(7);
  for (const double scale : {1.0, 1e-9, 1e9})
    for (size_t rowCount = 1; rowCount <= kMaxGameRows; ++rowCount)
      for (int trial = 0; trial < 40; ++trial) {
        Game game{.rowCount = rowCount};
        // Few values, so that many payoffs are equal.
        for (size_t row = 0; row < rowCount; ++row)
          for (double& payoff : game.payoffs[row])
            payoff = scale * (trial % 2 == 0 ? std::floor(4 * random.real()) : random.real() - 0.5);
        const GameSolution solution = game.solve();
        CHECK(solution.value == doctest::Approx(paymentFor(game, solution)).epsilon(1e-9).scale(scale));
      }
}
