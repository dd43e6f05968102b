#include "mesh/closed_surface.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>

#include "core/parallel.h"
#include "core/raise_flag.h"
#include "mesh/components.h"
#include "mesh/edge_chain.h"
#include "mesh/vertex_welding.h"

namespace asdfvk {
namespace {

/// The vertices of edges that are not regular, ascending.
std::vector<uint32_t> verticesOfOpenEdges(const TriangleMesh& mesh, const EdgeSurvey& survey) {
  std::vector<uint8_t> isOpen(mesh.vertices.size(), 0);
  forEachInParallel(mesh.faces.size(), [&](uint32_t f) {
    for (size_t i = 0; i < 3; ++i) {
      if (survey.edgeKinds[size_t{3} * f + i] == EdgeKind::Regular) continue;
      raiseFlag(isOpen[mesh.faces[f][i]]);
      raiseFlag(isOpen[mesh.faces[f][(i + 1) % 3]]);
    }
  });
  return indicesInParallel(isOpen.size(), [&](uint32_t vertex) { return isOpen[vertex] != 0; });
}

TriangleMesh withFaces(TriangleMesh mesh, const std::vector<Face>& faces) {
  if (!faces.empty()) mesh.faces = faces;
  return mesh;
}

bool hasOpenEdge(const EdgeSurvey& survey) {
  return survey.countOf(EdgeKind::Boundary) + survey.countOf(EdgeKind::Branching) > 0;
}

/// The faces with welded vertices, or none if no vertex of a face is welded.
std::vector<Face> weldedFaces(const TriangleMesh& mesh, const std::vector<uint32_t>& vertexOf) {
  std::vector<Face> faces(mesh.faces.begin(), mesh.faces.end());
  if (countInParallel(vertexOf.size(), [&](uint32_t vertex) { return vertexOf[vertex] != vertex; }) == 0) return {};
  forEachInParallel(faces.size(), [&](uint32_t face) {
    for (uint32_t& vertex : faces[face]) vertex = vertexOf[vertex];
  });
  return faces;
}

void closeTJunctions(const TriangleMesh& mesh, const Normalization& unit, double distance, SurfaceEdges& edges) {
  if (!edges.survey.isChainClosed() &&
      !sumAsChain(withFaces(mesh, edges.faces), unit, 2 * distance, edges.survey).empty())
    edges.hasTJunctions = true;
}

/// Welds the vertices of open edges that are at most `distance` apart.
void weldOpenEdges(const TriangleMesh& mesh, const Normalization& unit, double distance, SurfaceEdges& edges) {
  const TriangleMesh before = withFaces(mesh, edges.faces);
  std::vector<Face> faces =
      weldedFaces(before, weldVertices(before, unit, verticesOfOpenEdges(before, edges.survey), distance));
  if (faces.empty()) return;
  edges.faces = std::move(faces);
  edges.survey = surveyEdges(withFaces(mesh, edges.faces));
}

void weld(const TriangleMesh& mesh, const Normalization& unit, double distance, SurfaceEdges& edges) {
  weldOpenEdges(mesh, unit, distance, edges);
  closeTJunctions(mesh, unit, distance, edges);
}

/// Welds at the distance of CAD programs, but only the faces of components that this closes.
void weldWhereItCloses(const TriangleMesh& mesh, const Normalization& unit, SurfaceEdges& edges) {
  SurfaceEdges welded = edges;
  weld(mesh, unit, kCadWeldDistance, welded);
  const TriangleMesh after = withFaces(mesh, welded.faces);
  const Components components = findComponents(after, welded.survey);
  const auto isClosed = [&](uint32_t face) { return components.components[components.componentOf[face]].isClosed; };
  const TriangleMesh before = withFaces(mesh, edges.faces);
  std::vector<uint8_t> wasOpen(components.components.size(), 0);
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    for (size_t i = 0; i < 3; ++i)
      if (const EdgeKind kind = edges.survey.edgeKinds[size_t{3} * face + i];
          kind == EdgeKind::Boundary || kind == EdgeKind::Branching)
        wasOpen[components.componentOf[face]] = 1;
  uint64_t keptCount = 0, openCount = 0;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    if (wasOpen[components.componentOf[face]] == 0) continue;
    (isClosed(face) ? keptCount : openCount) += 1;
  }
  if (keptCount == 0) return;
  if (openCount > 0) {
    if (welded.faces.empty()) welded.faces.assign(before.faces.begin(), before.faces.end());
    for (uint32_t face = 0; face < mesh.faceCount(); ++face)
      if (!isClosed(face)) welded.faces[face] = before.faces[face];
    welded.survey = surveyEdges(withFaces(mesh, welded.faces));
    closeTJunctions(mesh, unit, kWeldDistance, welded);
  }
  edges = std::move(welded);
}

/// Sets the members that describe the welding.
void describeWelding(const TriangleMesh& mesh, const Normalization& unit, SurfaceEdges& edges) {
  if (edges.faces.empty()) return;
  edges.vertexOf.resize(mesh.vertices.size());
  for (uint32_t vertex = 0; vertex < edges.vertexOf.size(); ++vertex) edges.vertexOf[vertex] = vertex;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    for (size_t i = 0; i < 3; ++i) edges.vertexOf[mesh.faces[face][i]] = edges.faces[face][i];
  for (uint32_t vertex = 0; vertex < edges.vertexOf.size(); ++vertex) {
    const uint32_t other = edges.vertexOf[vertex];
    if (other == vertex) continue;
    ++edges.weldedVertexCount;
    const Vec3d p = unit.toNormalized(mesh.vertices[vertex]), q = unit.toNormalized(mesh.vertices[other]);
    edges.weldDistance = std::max(edges.weldDistance, length(p - q));
  }
}

/// Cuts a triangle from a vertex on a side to the opposite corner, and its parts in the same way. onSides: the vertices
/// on the sides, in the winding of the triangle.
void addParts(const FacePart& part, const std::array<std::span<const uint32_t>, 3>& onSides,
              std::vector<FacePart>& parts) {
  for (size_t k = 0; k < 3; ++k) {
    if (onSides[k].empty()) continue;
    const size_t half = onSides[k].size() / 2, next = (k + 1) % 3, opposite = (k + 2) % 3;
    const Face& corners = part.vertices;
    const uint32_t cut = onSides[k][half];
    addParts({{corners[k], cut, corners[opposite]}, part.face}, {onSides[k].first(half), {}, onSides[opposite]}, parts);
    addParts({{cut, corners[next], corners[opposite]}, part.face}, {onSides[k].subspan(half + 1), onSides[next], {}},
             parts);
    return;
  }
  parts.push_back(part);
}

}  // namespace

SurfaceEdges surveySurface(const TriangleMesh& mesh, const Normalization& unit) {
  SurfaceEdges edges;
  edges.survey = surveyEdges(mesh);
  if (edges.survey.isChainClosed()) return edges;
  weld(mesh, unit, kWeldDistance, edges);
  if (hasOpenEdge(edges.survey)) weldWhereItCloses(mesh, unit, edges);
  describeWelding(mesh, unit, edges);
  return edges;
}

std::vector<FacePart> conformingFaces(const TriangleMesh& mesh, const Normalization& unit) {
  SurfaceEdges edges;
  edges.survey = surveyEdges(mesh);
  weldOpenEdges(mesh, unit, kWeldDistance, edges);
  const TriangleMesh welded = withFaces(mesh, edges.faces);
  std::map<uint32_t, std::array<std::vector<uint32_t>, 3>> verticesOnEdges;
  for (DividedEdge& edge : findDividedEdges(welded, unit, 2 * kWeldDistance, edges.survey))
    verticesOnEdges[edge.corner / 3][edge.corner % 3] = std::move(edge.vertices);
  std::vector<FacePart> parts;
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const auto found = verticesOnEdges.find(face);
    if (found == verticesOnEdges.end())
      parts.push_back({welded.faces[face], face});
    else
      addParts({welded.faces[face], face}, {found->second[0], found->second[1], found->second[2]}, parts);
  }
  return parts;
}

}  // namespace asdfvk
