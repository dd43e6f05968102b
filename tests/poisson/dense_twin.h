#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <span>
#include <vector>

#include "mesh/dual_graph.h"

namespace asdfvk {

/// The interpolation by dense algebra over all faces, directly from its definition; independent of src/poisson except
/// for the weights.
struct DenseTwin {
  std::vector<Eigen::Index> faces;  ///< Unknowns: faces that a path connects to a constraint.
  Eigen::MatrixXd matrix;
  Eigen::VectorXd rightHandSide, solution;
  Eigen::MatrixXd laplacian;  ///< Over all faces.

  DenseTwin(const DualGraph& graph, std::span<const double> weights, std::span<const double> values,
            std::span<const double> divergence) {
    const Eigen::Index faceCount = graph.faceCount();
    laplacian = Eigen::MatrixXd::Zero(faceCount, faceCount);
    for (uint32_t f = 0; f < graph.faceCount(); ++f)
      for (uint32_t arc = graph.offsets[f]; arc < graph.offsets[f + 1]; ++arc) {
        if (graph.neighbours[arc] == f) continue;
        laplacian(f, f) += weights[arc];
        laplacian(f, graph.neighbours[arc]) -= weights[arc];
      }
    Eigen::VectorXd guidance = Eigen::VectorXd::Zero(faceCount), known = guidance;
    for (Eigen::Index f = 0; f < faceCount; ++f) {
      const size_t face = static_cast<size_t>(f);
      if (!divergence.empty() && std::isfinite(divergence[face])) guidance[f] = divergence[face];
      if (std::isfinite(values[face])) known[f] = values[face];
    }
    const Eigen::VectorXd whole = guidance - laplacian * known;
    for (Eigen::Index f : reachedUnknowns(values)) faces.push_back(f);
    matrix = laplacian(faces, faces);
    rightHandSide = whole(faces);
    solution = matrix.ldlt().solve(rightHandSide);
  }

  /// Bound of the largest error of a value divided by the relative residual ||D^-1 (b - A x)|| / ||D^-1 b||.
  [[nodiscard]] double largestErrorOverResidual() const {
    const Eigen::VectorXd diagonal = matrix.diagonal();
    const Eigen::MatrixXd magnified = matrix.inverse() * diagonal.asDiagonal();
    return magnified.cwiseAbs().rowwise().sum().maxCoeff() * rightHandSide.cwiseQuotient(diagonal).norm();
  }

 private:
  [[nodiscard]] std::vector<Eigen::Index> reachedUnknowns(std::span<const double> values) const {
    const Eigen::Index faceCount = laplacian.rows();
    std::vector<bool> reached(values.size());
    for (size_t f = 0; f < values.size(); ++f) reached[f] = std::isfinite(values[f]);
    for (bool grows = true; grows;) {
      grows = false;
      for (Eigen::Index f = 0; f < faceCount; ++f)
        for (Eigen::Index g = 0; g < faceCount && !reached[static_cast<size_t>(f)]; ++g)
          if (laplacian(f, g) != 0 && reached[static_cast<size_t>(g)]) reached[static_cast<size_t>(f)] = grows = true;
    }
    std::vector<Eigen::Index> result;
    for (size_t f = 0; f < values.size(); ++f)
      if (reached[f] && !std::isfinite(values[f])) result.push_back(static_cast<Eigen::Index>(f));
    return result;
  }
};

}  // namespace asdfvk
