#include "pipeline/judged_surface.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/parallel.h"
#include "mesh/closed_surface.h"
#include "mesh/coincident_faces.h"
#include "mesh/orientation.h"

namespace asdfvk {
namespace {

/// The arrays of the divided surface.
class SurfaceBuilder {
 public:
  SurfaceBuilder(const PreparedMesh& prepared, const Normalization& unit) : prepared_(prepared), unit_(unit) {
    const std::span<const Vec3d> vertices = prepared.mesh.vertices;
    storage_.vertices.assign(vertices.begin(), vertices.end());
  }

  void add(uint32_t triangle, FaceKind kind) { add(triangle, prepared_.mesh.faces[triangle], kind); }

  void add(uint32_t triangle, const FacePiece& piece) {
    std::vector<uint32_t> corners;
    for (const Vec3d& corner : piece.corners) corners.push_back(vertexAt(triangle, corner));
    for (size_t k = 1; k + 1 < corners.size(); ++k) {
      const Face face{corners[0], corners[k], corners[k + 1]};
      if (hasDistinctVertices(face)) add(triangle, face, piece.kind);
    }
  }

  /// Divides the triangles such that neighbours have whole edges in common: where a face begins to cross others, its
  /// pieces end inside of the edges of its neighbours.
  void makeConforming() {
    const std::vector<FacePart> parts = conformingFaces(storage_, unit_);
    storage_.faces.clear();
    const std::vector<uint32_t> triangles = std::exchange(triangles_, {});
    const std::vector<FaceKind> kinds = std::exchange(kinds_, {});
    for (const FacePart& part : parts)
      if (hasDistinctVertices(part.vertices) || prepared_.geometry.isDegenerate(triangles[part.face]))
        add(triangles[part.face], part.vertices, kinds[part.face]);
  }

  [[nodiscard]] const std::vector<uint32_t>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<FaceKind>& kinds() const { return kinds_; }

  /// The mesh with its geometry, without hierarchy.
  PreparedMesh finish() {
    PreparedMesh result;
    const TriangleMesh& original = prepared_.mesh;
    Polygons& polygons = storage_.polygons;
    for (const uint32_t triangle : triangles_) polygons.inputFaceOf.push_back(original.inputFaceOf(triangle));
    if (original.polygons.isEmpty()) {
      for (size_t face = 0; face <= original.faces.size(); ++face) polygons.firstCorner.push_back(3 * face);
      for (const Face& face : original.faces) polygons.corners.insert(polygons.corners.end(), face.begin(), face.end());
    } else {
      polygons.firstCorner.assign(original.polygons.firstCorner.begin(), original.polygons.firstCorner.end());
      polygons.corners.assign(original.polygons.corners.begin(), original.polygons.corners.end());
    }
    result.storage = std::move(storage_);
    result.mesh = result.storage;
    result.geometry = computeFaceGeometry(result.mesh);
    result.geometry.bounds = prepared_.geometry.bounds;
    result.components.components = prepared_.components.components;
    for (uint32_t face = 0; face < triangles_.size(); ++face) {
      result.components.componentOf.push_back(prepared_.components.componentOf[triangles_[face]]);
      // Pieces take the normals of their faces, because the normal of a narrow piece would be inexact. The pieces of a
      // degenerate face are degenerate.
      if (prepared_.geometry.isDegenerate(triangles_[face])) result.geometry.areas[face] = 0;
      if (!result.geometry.isDegenerate(face))
        result.geometry.normals[face] = prepared_.geometry.normals[triangles_[face]];
    }
    result.representatives = coincidentRepresentatives(result.mesh, {});
    result.unit = prepared_.unit;
    result.openEdges = prepared_.openEdges;
    result.traceableFaces =
        indicesInParallel(result.mesh.faceCount(), [&](uint32_t face) { return !result.geometry.isDegenerate(face); });
    return result;
  }

 private:
  void add(uint32_t triangle, const Face& face, FaceKind kind) {
    storage_.faces.push_back(face);
    triangles_.push_back(triangle);
    kinds_.push_back(kind);
  }

  /// A corner of the triangle, or a new vertex.
  uint32_t vertexAt(uint32_t triangle, const Vec3d& point) {
    const Face& face = prepared_.mesh.faces[triangle];
    for (const uint32_t vertex : face)
      if (unit_.toNormalized(prepared_.mesh.vertices[vertex]) == point) return vertex;
    const auto [found, isNew] =
        vertices_.try_emplace({point.x, point.y, point.z}, static_cast<uint32_t>(storage_.vertices.size()));
    if (isNew) storage_.vertices.push_back(unit_.toMesh(point));
    return found->second;
  }

  const PreparedMesh& prepared_;
  const Normalization& unit_;
  Mesh storage_;
  std::vector<uint32_t> triangles_;
  std::vector<FaceKind> kinds_;
  std::map<std::array<double, 3>, uint32_t> vertices_;
};

/// The same faces, in the same order, with the opposite orientation.
PreparedMesh reversed(const PreparedMesh& prepared) {
  PreparedMesh result;
  result.mesh = prepared.mesh;
  result.geometry = prepared.geometry;
  ownArrays(result);
  flipFaces(result.storage, result.geometry, std::vector<uint8_t>(prepared.mesh.faceCount(), 1));
  result.mesh = result.storage;
  result.components = prepared.components;
  result.representatives = prepared.representatives;
  result.unit = prepared.unit;
  result.openEdges = prepared.openEdges;
  result.traceableFaces = prepared.traceableFaces;
  return result;
}

}  // namespace

JudgedSurface::JudgedSurface(const PreparedScene& scene, bool isFlipped, const RunControl& control)
    : original_(scene), solids_(findSolids(scene.prepared.mesh, scene.prepared.components)) {
  const Material material(scene.view(), scene.prepared.graph, scene.prepared.components, isFlipped, control);
  keepBodies(material);
  joinSolids(scene.prepared.components, material.meetingComponents(), solids_);
  if (material.hasCuts() || material.hasKind(FaceKind::Inside) || scene.prepared.hasTJunctions)
    divide(material);
  else
    adopt(material);
}

JudgedSurface::JudgedSurface(const JudgedSurface& material, Space)
    : original_(material.original_),
      commonKind_(material.commonKind_),
      kinds_(material.kinds_),
      triangles_(material.triangles_),
      crossedCount_(material.crossedCount_),
      insideCount_(material.insideCount_),
      isSpace_(true),
      bodyOfComponent_(material.bodyOfComponent_),
      meetingBodies_(material.meetingBodies_) {
  own_ = std::make_unique<PreparedScene>(reversed(material.scene().prepared));
  own_->bvh = material.scene().bvh;
  SpaceParts space = findSpaceParts(
      *own_, [this](uint32_t face) { return kindOf(face) == FaceKind::Boundary; }, !triangles_.empty());
  solids_ = std::move(space.solids);
  voids_ = std::move(space.voids);
}

/// Bodies of components, before solids that meet are joined. A component that is wound outwards bounds a body, although
/// it has the place of a cavity if it lies in the material of another body.
void JudgedSurface::keepBodies(const Material& material) {
  const std::vector<Component>& components = original_.prepared.components.components;
  const auto windingOf = [&](uint32_t c) {
    const Component& each = components[c];
    return !each.isClosed || !each.isConsistentlyWound ? 0 : (each.signedVolume > 0) - (each.signedVolume < 0);
  };
  for (uint32_t c = 0; c < components.size(); ++c)
    bodyOfComponent_.push_back(windingOf(c) > 0 ? c : solids_.solidOf[components[c].firstFace]);
  for (uint32_t c = 0; c < components.size(); ++c) {
    if (windingOf(c) <= 0) continue;
    int winding = 0;  // Number of bodies around, out to the component `around`.
    for (uint32_t around = c; winding <= 0 && solids_.parentOf[around] != around;) {
      around = solids_.parentOf[around];
      winding += windingOf(around);
      if (winding > 0) meetingBodies_.push_back(std::minmax(c, around));
    }
  }
  for (const auto& [first, second] : material.meetingComponents()) {
    const std::pair<uint32_t, uint32_t> bodies = std::minmax(bodyOfComponent_[first], bodyOfComponent_[second]);
    if (bodies.first != bodies.second) meetingBodies_.push_back(bodies);
  }
  std::sort(meetingBodies_.begin(), meetingBodies_.end());
  meetingBodies_.erase(std::unique(meetingBodies_.begin(), meetingBodies_.end()), meetingBodies_.end());
}

void JudgedSurface::adopt(const Material& material) {
  const uint32_t faceCount = original_.prepared.mesh.faceCount();
  if (faceCount > 0) commonKind_ = material.kindOf(0);
  for (uint32_t face = 0; face < faceCount && kinds_.empty(); ++face)
    if (material.kindOf(face) != commonKind_) kinds_.resize(faceCount);
  for (uint32_t face = 0; face < kinds_.size(); ++face) kinds_[face] = material.kindOf(face);
}

void JudgedSurface::divide(const Material& material) {
  const PreparedMesh& prepared = original_.prepared;
  const uint32_t faceCount = prepared.mesh.faceCount();
  std::vector<std::vector<FacePiece>> pieces(faceCount);
  forEachInParallel(faceCount, [&](uint32_t face) {
    if (material.isCut(face) && !prepared.geometry.isDegenerate(face)) pieces[face] = material.piecesOf(face);
  });
  SurfaceBuilder builder(prepared, original_.bvh.normalization);
  uint64_t lastCrossed = UINT64_MAX, lastInside = UINT64_MAX;
  const auto count = [&](uint32_t face, uint64_t& last, uint64_t& total) {
    const uint64_t inputFace = prepared.mesh.inputFaceOf(face);
    if (inputFace != last) ++total;
    last = inputFace;
  };
  for (uint32_t face = 0; face < faceCount; ++face) {
    const auto isOf = [&](FaceKind kind) { return [kind](const FacePiece& piece) { return piece.kind == kind; }; };
    const std::vector<FacePiece>& ofFace = pieces[face];
    const FaceKind kind = ofFace.empty() ? material.kindOf(face) : ofFace[0].kind;
    if (std::all_of(ofFace.begin(), ofFace.end(), isOf(kind))) {  // The face is whole.
      if (kind == FaceKind::Inside) {
        count(face, lastInside, insideCount_);
        continue;
      }
      builder.add(face, kind);
      continue;
    }
    count(face, lastCrossed, crossedCount_);
    if (std::any_of(ofFace.begin(), ofFace.end(), isOf(FaceKind::Inside))) count(face, lastInside, insideCount_);
    for (const FacePiece& piece : ofFace)
      if (piece.kind != FaceKind::Inside) builder.add(face, piece);
  }
  builder.makeConforming();
  triangles_ = builder.triangles();
  kinds_ = builder.kinds();
  std::vector<uint32_t> solidOf;
  for (const uint32_t triangle : triangles_) solidOf.push_back(solids_.solidOf[triangle]);
  solids_.solidOf = std::move(solidOf);
  own_ = std::make_unique<PreparedScene>(builder.finish());
  own_->bvh = buildBvh(own_->prepared.mesh, own_->prepared.geometry, own_->prepared.representatives);
}

}  // namespace asdfvk
