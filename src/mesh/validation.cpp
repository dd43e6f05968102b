#include "mesh/validation.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <atomic>

#include "mesh/edges.h"

namespace asdfvk {
namespace {

struct EdgeCounts {
  uint64_t boundary = 0, nonManifold = 0, inconsistent = 0;

  EdgeCounts& operator+=(const EdgeCounts& other) {
    boundary += other.boundary;
    nonManifold += other.nonManifold;
    inconsistent += other.inconsistent;
    return *this;
  }
};

bool runsFromTo(const Face& face, uint32_t from, uint32_t to) {
  return (face[0] == from && face[1] == to) || (face[1] == from && face[2] == to) || (face[2] == from && face[0] == to);
}

EdgeCounts countEdges(const Mesh& mesh) {
  const EdgeTable edges = EdgeTable::build(
      mesh, [&](uint32_t f) { return hasDistinctVertices(mesh.faces[f]) && mesh.hasFiniteCorners(f); });
  const auto countRange = [&](const tbb::blocked_range<uint32_t>& range, EdgeCounts counts) {
    for (uint32_t lower = range.begin(); lower < range.end(); ++lower) {
      edges.forEachEdgeFrom(lower, [&](uint32_t upper, std::span<const EdgeEntry> around) {
        if (around.size() == 1) ++counts.boundary;
        if (around.size() > 2) ++counts.nonManifold;
        if (around.size() == 2 && runsFromTo(mesh.faces[around[0].face()], lower, upper) ==
                                      runsFromTo(mesh.faces[around[1].face()], lower, upper))
          ++counts.inconsistent;
      });
    }
    return counts;
  };
  return tbb::parallel_reduce(tbb::blocked_range<uint32_t>(0, edges.vertexCount(), 4096), EdgeCounts{}, countRange,
                              [](EdgeCounts a, const EdgeCounts& b) { return a += b; });
}

uint64_t countUnreferencedVertices(const Mesh& mesh) {
  std::vector<uint8_t> isUsed(mesh.vertices.size(), 0);
  for (const Face& face : mesh.faces)
    for (uint32_t vertex : face) isUsed[vertex] = 1;
  return static_cast<uint64_t>(std::count(isUsed.begin(), isUsed.end(), uint8_t{0}));
}

uint64_t countShortPolygons(const Polygons& polygons) {
  uint64_t count = 0;
  for (size_t i = 0; i + 1 < polygons.firstCorner.size(); ++i)
    if (polygons.firstCorner[i + 1] - polygons.firstCorner[i] < 3) ++count;
  return count;
}

}  // namespace

uint64_t countFacesWithIndexOutOfRange(const Mesh& mesh) {
  return static_cast<uint64_t>(std::count_if(mesh.faces.begin(), mesh.faces.end(), [&](const Face& face) {
    return *std::max_element(face.begin(), face.end()) >= mesh.vertices.size();
  }));
}

MeshDefects findDefects(const Mesh& mesh, const FaceGeometry& geometry, std::span<const uint32_t> representatives) {
  MeshDefects defects;
  for (uint32_t f = 0; f < mesh.faceCount(); ++f) {
    if (representatives[f] != f) ++defects.duplicateFaceCount;
    if (!geometry.isDegenerate(f)) continue;
    if (mesh.hasFiniteCorners(f)) {
      ++defects.zeroAreaFaceCount;
    } else {
      ++defects.nonFiniteFaceCount;
    }
  }
  for (const Vec3d& vertex : mesh.vertices)
    if (!isFinite(vertex)) ++defects.nonFiniteVertexCount;
  const EdgeCounts edges = countEdges(mesh);
  defects.boundaryEdgeCount = edges.boundary;
  defects.nonManifoldEdgeCount = edges.nonManifold;
  defects.inconsistentEdgeCount = edges.inconsistent;
  defects.unreferencedVertexCount = countUnreferencedVertices(mesh);
  defects.shortPolygonCount = countShortPolygons(mesh.polygons);
  defects.isOfPolygons = !mesh.polygons.isEmpty();
  return defects;
}

std::vector<std::string> MeshDefects::sentences() const {
  std::vector<std::string> result;
  const auto tell = [&](uint64_t count, const char* one, const char* many) {
    if (count == 1) result.push_back(fmt::format("1 {}", one));
    if (count > 1) result.push_back(fmt::format("{} {}", count, many));
  };
  const auto tellOfFaces = [&](uint64_t count, const char* one, const char* many) {
    if (count == 1) result.push_back(fmt::format("1 {} {}", isOfPolygons ? "triangle" : "face", one));
    if (count > 1) result.push_back(fmt::format("{} {} {}", count, isOfPolygons ? "triangles" : "faces", many));
  };
  tell(nonFiniteVertexCount, "vertex has a coordinate that is no finite number",
       "vertices have coordinates that are no finite numbers");
  tellOfFaces(nonFiniteFaceCount, "has a corner that is no finite point: it is left out and gets no value",
              "have corners that are no finite points: they are left out and get no value");
  tell(shortPolygonCount, "input face has fewer than three corners: it gets no value",
       "input faces have fewer than three corners: they get no value");
  tellOfFaces(zeroAreaFaceCount, "has zero area: it casts no rays and is interpolated",
              "have zero area: they cast no rays and are interpolated");
  tellOfFaces(duplicateFaceCount, "lies exactly on an earlier one: rays pass through its own copies",
              "lie exactly on earlier ones: rays pass through their own copies");
  tell(nonManifoldEdgeCount, "edge has more than two faces: values are interpolated across all of them",
       "edges have more than two faces: values are interpolated across all of them");
  tell(inconsistentEdgeCount, "edge has two faces of opposite winding: on one side of it rays leave outwards",
       "edges have two faces of opposite winding: on one side of them rays leave outwards");
  tell(boundaryEdgeCount, "edge has only one face: the surface is open there and rays can escape",
       "edges have only one face: the surface is open there and rays can escape");
  tell(unreferencedVertexCount, "vertex belongs to no triangle: it is ignored",
       "vertices belong to no triangle: they are ignored");
  return result;
}

}  // namespace asdfvk
