#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/random.h"
#include "mesh/arc_angles.h"
#include "mesh/dual_graph.h"
#include "mesh/face_geometry.h"
#include "mesh/mesh.h"
#include "poisson/poisson_solver.h"
#include "poisson/poisson_system.h"

namespace asdfvk {

/// A closed torus of 2 * rings * sides triangles.
inline Mesh torus(uint32_t rings, uint32_t sides) {
  Mesh mesh;
  for (uint32_t i = 0; i < rings; ++i)
    for (uint32_t j = 0; j < sides; ++j) {
      const double u = 2 * std::numbers::pi * i / rings, v = 2 * std::numbers::pi * j / sides;
      const double radius = 3 + std::cos(v);
      mesh.vertices.push_back({radius * std::cos(u), radius * std::sin(u), std::sin(v)});
    }
  for (uint32_t i = 0; i < rings; ++i)
    for (uint32_t j = 0; j < sides; ++j) {
      const uint32_t nextI = (i + 1) % rings, nextJ = (j + 1) % sides;
      const uint32_t a = i * sides + j, b = nextI * sides + j, c = nextI * sides + nextJ, d = i * sides + nextJ;
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  return mesh;
}

/// ||D^-1 (b - A x)|| / ||D^-1 b|| in double; 0 for an empty system and for a residual of 0; infinite where b is 0 and
/// the residual is not.
inline double relativeResidual(const PoissonSystem& system, std::span<const double> solution) {
  std::vector<double> residual(solution.size());
  computeResidual(system, solution, residual);
  const double norm = residualNorm(system, residual);
  return norm == 0 ? 0 : norm / rightHandNorm(system);
}

/// A dual graph and barycentres given by hand; each edge is an arc in both directions.
struct HandGraph {
  DualGraph graph;
  FaceGeometry geometry;

  HandGraph(const std::vector<Vec3d>& barycentres, const std::vector<std::pair<uint32_t, uint32_t>>& edges) {
    std::vector<std::vector<uint32_t>> rows(barycentres.size());
    for (auto [f, g] : edges) {
      rows[f].push_back(g);
      rows[g].push_back(f);
    }
    graph.offsets.push_back(0);
    for (auto& row : rows) {
      std::sort(row.begin(), row.end());
      graph.neighbours.insert(graph.neighbours.end(), row.begin(), row.end());
      graph.offsets.push_back(static_cast<uint32_t>(graph.neighbours.size()));
    }
    geometry.barycentres.assign(barycentres.begin(), barycentres.end());
    geometry.normals.assign(barycentres.size(), {0, 0, 1});
    geometry.areas.assign(barycentres.size(), 1.0);
    for (const Vec3d& p : barycentres) geometry.bounds.add(p);
  }
};

/// The component of each face.
inline std::vector<uint32_t> searchComponents(const DualGraph& graph) {
  std::vector<uint32_t> componentOf(graph.faceCount(), UINT32_MAX);
  for (uint32_t face = 0, count = 0; face < graph.faceCount(); ++face) {
    if (componentOf[face] != UINT32_MAX) continue;
    std::vector<uint32_t> stack{face};
    componentOf[face] = count;
    while (!stack.empty()) {
      const uint32_t next = stack.back();
      stack.pop_back();
      for (const uint32_t neighbour : graph.neighboursOf(next))
        if (componentOf[neighbour] == UINT32_MAX) {
          componentOf[neighbour] = count;
          stack.push_back(neighbour);
        }
    }
    ++count;
  }
  return componentOf;
}

/// The paper's system: weights 1 / distance.
inline PoissonSystem distanceSystem(const DualGraph& graph, const FaceGeometry& geometry,
                                    std::span<const double> values, std::span<const double> divergence = {}) {
  return buildPoissonSystem(graph, distanceWeights(graph, geometry), values, divergence, searchComponents(graph));
}

/// An interpolation, and its system by which solutions are judged.
struct Equation {
  DualGraph graph;
  UnsetVector<double> weights;
  std::vector<double> constraints, divergence, firstGuess;
  std::vector<uint32_t> componentOf;
  PoissonSystem system;

  /// firstGuess: empty for the mean of the constraints.
  Equation(DualGraph theGraph, std::span<const double> theWeights, std::vector<double> theConstraints,
           std::vector<double> theDivergence = {}, std::vector<double> theFirstGuess = {})
      : graph(std::move(theGraph)),
        weights(theWeights.begin(), theWeights.end()),
        constraints(std::move(theConstraints)),
        divergence(std::move(theDivergence)),
        firstGuess(std::move(theFirstGuess)),
        componentOf(searchComponents(graph)),
        system(buildPoissonSystem(graph, weights, constraints, divergence, componentOf, firstGuess)) {
    if (firstGuess.empty()) firstGuess.assign(constraints.size(), kNoValue);
  }

  [[nodiscard]] GraphProblem problem() const { return {constraints, firstGuess, {}, divergence, componentOf}; }
};

/// The paper's equation: weights 1 / distance.
inline Equation distanceEquation(const DualGraph& graph, const FaceGeometry& geometry, std::vector<double> values,
                                 std::vector<double> divergence = {}) {
  return {graph, distanceWeights(graph, geometry), std::move(values), std::move(divergence)};
}

/// A row of faces at unit distances with constraints at the first and the last.
inline Equation chainEquation(size_t faceCount, double first, double last) {
  std::vector<Vec3d> barycentres;
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (uint32_t i = 0; i < faceCount; ++i) {
    barycentres.push_back({static_cast<double>(i), 0, 0});
    if (i > 0) edges.push_back({i - 1, i});
  }
  std::vector<double> values(faceCount, kNoValue);
  values.front() = first;
  values.back() = last;
  const HandGraph hand(barycentres, edges);
  return distanceEquation(hand.graph, hand.geometry, values);
}

inline PoissonSystem chain(size_t faceCount, double first, double last) {
  return chainEquation(faceCount, first, last).system;
}

/// A torus with constraints, uniform in [1, 2), on about one face in ten.
inline Equation torusEquation(uint32_t rings, uint32_t sides, double unit = 1) {
  const Mesh mesh = torus(rings, sides);
  Random random(5);
  std::vector<double> values(mesh.faces.size(), kNoValue);
  for (double& value : values)
    if (random.index(10) == 0) value = unit * (1 + random.real());
  return distanceEquation(buildDualGraph(mesh), computeFaceGeometry(mesh), values);
}

inline PoissonSystem torusSystem(uint32_t rings, uint32_t sides) { return torusEquation(rings, sides).system; }

}  // namespace asdfvk
