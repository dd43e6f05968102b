#include "mesh/validation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "core/raise_flag.h"
#include "core/text.h"

namespace asdfvk {
namespace {

uint64_t countUnreferencedVertices(const TriangleMesh& mesh) {
  std::vector<uint8_t> isUsed(mesh.vertices.size(), 0);
  forEachInParallel(mesh.faces.size(), [&](uint32_t f) {
    for (const uint32_t vertex : mesh.faces[f]) raiseFlag(isUsed[vertex]);
  });
  return countInParallel(isUsed.size(), [&](uint32_t vertex) { return !isUsed[vertex]; });
}

uint64_t countShortPolygons(const PolygonsView& polygons) {
  uint64_t count = 0;
  for (size_t i = 0; i + 1 < polygons.firstCorner.size(); ++i)
    if (polygons.firstCorner[i + 1] - polygons.firstCorner[i] < 3) ++count;
  return count;
}

void requireMultipleOf3(size_t size, const char* array) {
  if (size % 3 != 0)
    throw Error(ErrorCode::ArraySize, fmt::format("the {} have {} entries, which is not a multiple of 3", array, size));
}

void requirePolygons(const MeshView& view) {
  const std::span<const uint64_t> first = view.firstCorner();
  if (first.front() != 0 || first.back() != view.corners().size() || !std::is_sorted(first.begin(), first.end()))
    throw Error(ErrorCode::ArraySize,
                fmt::format("the first corners of the polygons do not ascend from 0 to {}", view.corners().size()));
}

/// Checks the triangulation of a mesh of polygons.
void requireTriangulation(const Mesh& mesh) {
  if (mesh.polygons.isEmpty()) return;
  requireAtMost(kMaxTriangleCount, mesh.faces.size(), "triangles");
  const std::vector<uint32_t>& inputFaceOf = mesh.polygons.inputFaceOf;
  if (inputFaceOf.size() != mesh.faces.size())
    throw Error(ErrorCode::ArraySize, "the polygons of the mesh do not assign an input face to each triangle");
  if (!inputFaceOf.empty() &&
      (inputFaceOf.back() >= mesh.inputFaceCount() || !std::is_sorted(inputFaceOf.begin(), inputFaceOf.end())))
    throw Error(ErrorCode::ArraySize,
                fmt::format("the input faces of the triangles do not ascend from 0 to {}", mesh.inputFaceCount() - 1));
}

[[noreturn]] void failIndex(uint64_t faceCount, const char* face, size_t vertexCount) {
  throw Error(ErrorCode::IndexOutOfRange,
              fmt::format("{} with a vertex that does not exist: the mesh has {}", counted(faceCount, face),
                          counted(vertexCount, "vertex", "vertices")));
}

void requireIndices(const MeshView& view) {
  const std::span<const uint32_t> corners = view.corners();
  const size_t vertexCount = view.vertexCount();
  if (const Mesh* mesh = view.mesh(); mesh != nullptr && !mesh->polygons.isEmpty()) {
    if (const uint64_t count = countFacesWithIndexOutOfRange(*mesh); count > 0)
      failIndex(count, "triangle", vertexCount);
  }
  constexpr size_t kBlockSize = 1 << 16;
  // The number of blocks fits into 32 bits; the number of corners may not.
  const size_t blockCount = (corners.size() + kBlockSize - 1) / kBlockSize;
  const auto isBad = [&](uint32_t corner) { return corner >= vertexCount; };
  if (countInParallel(blockCount, [&](size_t block) {
        const auto part =
            corners.subspan(block * kBlockSize, std::min(kBlockSize, corners.size() - block * kBlockSize));
        return std::any_of(part.begin(), part.end(), isBad);
      }) == 0)
    return;
  uint64_t faceCount = 0;
  for (uint64_t i = 0; i < view.inputFaceCount(); ++i) {
    const size_t begin = view.firstCorner().empty() ? 3 * i : view.firstCorner()[i];
    const size_t end = view.firstCorner().empty() ? begin + 3 : view.firstCorner()[i + 1];
    const std::span<const uint32_t> face = corners.subspan(begin, end - begin);
    faceCount += std::any_of(face.begin(), face.end(), isBad) ? 1 : 0;
  }
  failIndex(faceCount, "face", vertexCount);
}

}  // namespace

void requireValidArrays(const MeshView& view) {
  requireMultipleOf3(view.doubles().size() + view.floats().size(), "vertex positions");
  if (view.firstCorner().empty()) {
    requireMultipleOf3(view.corners().size(), "triangle indices");
  } else {
    requirePolygons(view);
  }
  requireAtMost(kMaxIndexCount, view.vertexCount(), "vertices");
  requireAtMost(view.firstCorner().empty() ? kMaxTriangleCount : kMaxIndexCount, view.inputFaceCount(), "faces");
  if (view.mesh() != nullptr) requireTriangulation(*view.mesh());
  requireIndices(view);
}

uint64_t countFacesWithIndexOutOfRange(const TriangleMesh& mesh) {
  return countInParallel(mesh.faces.size(), [&](uint32_t f) {
    const auto [a, b, c] = mesh.faces[f];
    return std::max({a, b, c}) >= mesh.vertices.size();
  });
}

MeshDefects findDefects(const TriangleMesh& mesh, const FaceGeometry& geometry,
                        std::span<const uint32_t> representatives, const EdgeSurvey& edges) {
  const uint32_t faceCount = mesh.faceCount();
  MeshDefects defects;
  defects.duplicateFaceCount = countInParallel(faceCount, [&](uint32_t f) { return representatives[f] != f; });
  const uint64_t degenerateCount = countInParallel(faceCount, [&](uint32_t f) { return geometry.isDegenerate(f); });
  if (degenerateCount > 0)
    defects.nonFiniteFaceCount = countInParallel(faceCount, [&](uint32_t f) { return !mesh.hasFiniteCorners(f); });
  defects.zeroAreaFaceCount = degenerateCount - defects.nonFiniteFaceCount;
  defects.nonFiniteVertexCount =
      countInParallel(mesh.vertices.size(), [&](uint32_t vertex) { return !isFinite(mesh.vertices[vertex]); });
  defects.boundaryEdgeCount = edges.countOf(EdgeKind::Boundary);
  defects.nonManifoldEdgeCount = edges.nonManifoldEdgeCount;
  defects.inconsistentEdgeCount = edges.countOf(EdgeKind::Inconsistent);
  defects.unreferencedVertexCount = countUnreferencedVertices(mesh);
  defects.shortPolygonCount = countShortPolygons(mesh.polygons);
  return defects;
}

double float32StepOf(std::span<const Vec3d> vertices) {
  struct Coordinates {
    float greatest = 0;
    bool areFloats = true;
  };
  const auto coordinatesOf = [&](size_t begin, size_t end) {
    Coordinates all;
    for (size_t v = begin; v < end && all.areFloats; ++v)
      for (size_t axis = 0; axis < 3; ++axis) {
        const double c = vertices[v][axis];
        if (!std::isfinite(c)) continue;
        const auto coordinate = static_cast<float>(c);
        all.areFloats = all.areFloats && static_cast<double>(coordinate) == c;
        all.greatest = std::max(all.greatest, std::abs(coordinate));
      }
    return all;
  };
  const auto joined = [](const Coordinates& a, const Coordinates& b) {
    return Coordinates{std::max(a.greatest, b.greatest), a.areFloats && b.areFloats};
  };
  const auto [greatest, areFloats] = foldInParallel<Coordinates>(vertices.size(), coordinatesOf, joined);
  if (!areFloats) return 0;
  return static_cast<double>(greatest) - static_cast<double>(std::nextafter(greatest, 0.0f));
}

}  // namespace asdfvk
