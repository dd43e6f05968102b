#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/random.h"
#include "fixtures.h"
#include "generate/shapes.h"
#include "poisson/poisson_system.h"

namespace asdfvk {

inline constexpr std::array<ArcWeights, 2> kArcWeights{ArcWeights::Distance, ArcWeights::Feature};

/// An interpolation without its weights.
struct SampleProblem {
  std::string name;
  DualGraph graph;
  FaceGeometry geometry;
  bool isManifold = true;
  std::vector<double> values;  ///< In [1, 2), on about one face in eight; some components have none.

  SampleProblem(std::string theName, const Mesh& mesh, uint64_t randomSeed = 5)
      : name(std::move(theName)), graph(buildDualGraph(mesh)), geometry(computeFaceGeometry(mesh)) {
    Random random(randomSeed);
    values.assign(mesh.faces.size(), kNoValue);
    for (double& value : values)
      if (random.index(8) == 0) value = 1 + random.real();
  }
};

/// Random faces over few vertices: degenerate ones, duplicates, edges of many faces. Far from them a sheet of two faces
/// and a single face.
inline Mesh randomFaces(uint32_t vertexCount, uint32_t faceCount, uint64_t randomSeed) {
  Mesh mesh;
  Random random(randomSeed);
  for (uint32_t i = 0; i < vertexCount; ++i) mesh.vertices.push_back({random.real(), random.real(), random.real()});
  mesh.vertices[1] = mesh.vertices[0];
  for (uint32_t i = 0; i < faceCount; ++i)
    mesh.faces.push_back({random.index(vertexCount), random.index(vertexCount), random.index(vertexCount)});
  const uint32_t n = vertexCount;
  mesh.vertices.insert(mesh.vertices.end(), {{5, 5, 5}, {6, 5, 5}, {6, 6, 5}, {5, 6, 6}, {9, 9, 9}, {8, 9, 9}});
  mesh.faces.push_back({n, n + 1, n + 2});
  mesh.faces.push_back({n, n + 2, n + 3});
  mesh.faces.push_back({n + 3, n + 4, n + 5});
  return mesh;
}

/// Faces (0, 1, i) for i = 2 .. pageCount + 1, which share the edge 0-1, and a further face at the edge 1-i of each.
inline Mesh openBook(uint32_t pageCount) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 0, 1}};
  for (uint32_t i = 0; i < pageCount; ++i) {
    const double angle = 3.0 * i / pageCount;
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), 0.5});
  }
  for (uint32_t i = 0; i < pageCount; ++i) {
    mesh.faces.push_back({0, 1, 2 + i});
    mesh.vertices.push_back(mesh.vertices[2 + i] * 2.0);
    mesh.faces.push_back({1, 2 + i, static_cast<uint32_t>(mesh.vertices.size() - 1)});
  }
  return mesh;
}

/// Small enough for dense algebra.
inline std::vector<SampleProblem> sampleProblems() {
  std::vector<SampleProblem> problems;
  problems.emplace_back("torus", torus(14, 10));
  problems.emplace_back("cube", generateShape("cube", 300).mesh);
  problems.emplace_back("animal", generateShape("animal", 400).mesh);
  problems.emplace_back("sparse random faces", randomFaces(60, 300, 1));
  problems.emplace_back("dense random faces", randomFaces(25, 300, 2));
  problems.emplace_back("book of 30 pages", openBook(30));
  problems.emplace_back("book of 40 pages", openBook(40));
  for (size_t i = 3; i < problems.size(); ++i) problems[i].isManifold = false;
  return problems;
}

struct Setting {
  const SampleProblem& problem;
  ArcWeights kind;
  UnsetVector<double> weights;  ///< One per arc.
};

inline UnsetVector<double> weightsOf(ArcWeights kind, const DualGraph& graph, const FaceGeometry& geometry) {
  return kind == ArcWeights::Feature ? featureWeights(arcAngles(graph, geometry)) : distanceWeights(graph, geometry);
}

/// Calls test(setting) for each problem with each kind of weights; a failed check prints both.
template <typename Test>
void forEachSetting(const Test& test) {
  for (const SampleProblem& problem : sampleProblems())
    for (ArcWeights kind : kArcWeights) {
      CAPTURE(problem.name);
      CAPTURE(static_cast<int>(kind));
      test(Setting{problem, kind, weightsOf(kind, problem.graph, problem.geometry)});
    }
}

}  // namespace asdfvk
