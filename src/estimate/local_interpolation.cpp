#include "estimate/local_interpolation.h"

#include <cmath>
#include <limits>

#include "core/index_table.h"
#include "core/parallel.h"
#include "mesh/mesh.h"

namespace asdfvk {
namespace {

// Residual at which the iteration ends, relative to the initial residual. The measured error is the difference between
// the initial values and the solution. kLocalReduction is therefore the relative precision of the measured error.
constexpr double kLocalReduction = 3e-3;
constexpr uint32_t kMaxLocalIterations = 1000;
constexpr uint32_t kConstrainedRow = std::numeric_limits<uint32_t>::max();

/// Solves the equation around one face after another.
class Patch {
 public:
  explicit Patch(const SolvedInterpolation& solved) : solved_(solved) {}

  [[nodiscard]] double valueAt(uint32_t face) {
    collect(face);
    assemble();
    return isDetermined_ ? solve() : kNoValue;
  }

 private:
  struct Column {
    uint32_t row;
    double weight;
  };

  void collect(uint32_t centre);
  void assemble();
  void addRow(uint32_t face);
  [[nodiscard]] double solve();
  [[nodiscard]] double multiply();
  [[nodiscard]] double step(double length);

  const SolvedInterpolation& solved_;
  IndexTable<uint32_t> rows_;    // Rows of the faces below.
  std::vector<uint32_t> faces_;  // First the unknowns, beginning with the centre; then faces at the boundary.
  size_t unknownCount_ = 0;
  std::vector<uint32_t> offsets_;
  std::vector<Column> columns_;
  std::vector<double> diagonal_, residual_, solution_;  // residual_ is at first the initial residual.
  std::vector<double> preconditioned_, direction_, product_;
  bool isDetermined_ = false;  // Whether a boundary value was found.
};

/// Collects faces breadth-first, not beyond constraints, until there are kLocalConstraintCount constraints.
void Patch::collect(uint32_t centre) {
  faces_.assign(1, centre);
  rows_.clear();
  rows_.add(centre).first.value = 0;
  uint32_t constraintCount = 0;
  unknownCount_ = 0;
  for (; unknownCount_ < faces_.size() && constraintCount < kLocalConstraintCount; ++unknownCount_)
    for (const uint32_t neighbour : solved_.graph.neighboursOf(faces_[unknownCount_])) {
      const bool isConstrained = std::isfinite(solved_.constraints[neighbour]);
      const auto [row, isNew] = rows_.add(neighbour);
      if (!isNew) continue;
      row.value = isConstrained ? kConstrainedRow : static_cast<uint32_t>(faces_.size());
      if (isConstrained)
        ++constraintCount;
      else
        faces_.push_back(neighbour);
    }
}

void Patch::assemble() {
  for (std::vector<double>* values : {&diagonal_, &residual_, &solution_}) values->clear();
  offsets_.assign(1, 0);
  columns_.clear();
  isDetermined_ = false;
  for (size_t row = 0; row < unknownCount_; ++row) addRow(faces_[row]);
  preconditioned_.resize(unknownCount_);
  direction_.assign(unknownCount_, 0);
  product_.assign(unknownCount_, 0);
}

void Patch::addRow(uint32_t face) {
  const DualGraph& graph = solved_.graph;
  const double own = std::isfinite(solved_.solution[face]) ? solved_.solution[face] : 0;
  double diagonal = 0, residual = 0;
  if (!solved_.divergence.empty() && std::isfinite(solved_.divergence[face])) residual += solved_.divergence[face];
  for (uint32_t arc = graph.offsets[face]; arc < graph.offsets[face + 1]; ++arc) {
    const uint32_t neighbour = graph.neighbours[arc];
    if (neighbour == face) continue;
    const double weight = solved_.weights[arc];
    const uint32_t row = rows_[neighbour];
    const bool isUnknown = row < unknownCount_;
    double value = row == kConstrainedRow ? solved_.constraints[neighbour] : solved_.solution[neighbour];
    if (!std::isfinite(value)) {
      if (!isUnknown) continue;
      value = 0;
    }
    diagonal += weight;
    residual += weight * (value - own);
    if (!solved_.guide.empty())
      if (const double difference = solved_.guide[face] - solved_.guide[neighbour]; std::isfinite(difference))
        residual += weight * difference;
    if (isUnknown)
      columns_.push_back({row, weight});
    else
      isDetermined_ = true;
  }
  offsets_.push_back(static_cast<uint32_t>(columns_.size()));
  diagonal_.push_back(diagonal);
  residual_.push_back(residual);
  solution_.push_back(own);
}

/// Computes product_, the matrix times the direction. Returns the scalar product of product_ and the direction.
double Patch::multiply() {
  double curvature = 0;
  for (size_t row = 0; row < unknownCount_; ++row) {
    double sum = diagonal_[row] * direction_[row];
    for (uint32_t i = offsets_[row]; i < offsets_[row + 1]; ++i)
      sum -= columns_[i].weight * direction_[columns_[i].row];
    product_[row] = sum;
    curvature += direction_[row] * sum;
  }
  return curvature;
}

/// Moves the solution along the direction. Returns the square of the preconditioned norm of the residual.
double Patch::step(double length) {
  double squared = 0;
  for (size_t row = 0; row < unknownCount_; ++row) {
    solution_[row] += length * direction_[row];
    residual_[row] -= length * product_[row];
    preconditioned_[row] = residual_[row] / diagonal_[row];
    squared += residual_[row] * preconditioned_[row];
  }
  return squared;
}

/// Returns the value at the centre. Uses conjugate gradients with the diagonal as preconditioner.
double Patch::solve() {
  double squared = step(0);
  const double target = kLocalReduction * kLocalReduction * squared;
  direction_ = preconditioned_;
  for (uint32_t i = 0; i < kMaxLocalIterations && squared > target; ++i) {
    const double curvature = multiply();
    if (!(curvature > 0)) break;
    const double next = step(squared / curvature), beta = next / squared;
    for (size_t row = 0; row < unknownCount_; ++row) direction_[row] = preconditioned_[row] + beta * direction_[row];
    squared = next;
  }
  return solution_.front();
}

}  // namespace

std::vector<double> interpolateLocally(const SolvedInterpolation& solved, std::span<const uint32_t> faces) {
  std::vector<double> values(faces.size(), kNoValue);
  constexpr size_t kGrain = 16;
  forEachRange(faces.size(), kGrain, [&](size_t begin, size_t end) {
    Patch patch(solved);
    for (size_t i = begin; i < end; ++i) values[i] = patch.valueAt(faces[i]);
  });
  return values;
}

}  // namespace asdfvk
