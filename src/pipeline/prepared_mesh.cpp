#include "pipeline/prepared_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "asdf_vk/error.h"
#include "core/parallel.h"
#include "describe/warnings.h"
#include "mesh/closed_surface.h"
#include "mesh/coincident_faces.h"
#include "mesh/input_faces.h"
#include "mesh/orientation.h"
#include "mesh/validation.h"
#include "mesh/winding.h"

namespace asdfvk {

// The arrays of a caller are used in place.
static_assert(sizeof(Vec3d) == 3 * sizeof(double) && sizeof(Face) == 3 * sizeof(uint32_t));

TriangleMesh trianglesOf(const MeshView& view, Mesh& storage) {
  requireValidArrays(view);
  if (view.inputFaceCount() == 0)
    throw Error(ErrorCode::EmptyMesh, "the mesh has no faces; a shape diameter needs a surface");
  const std::span<const uint64_t> first = view.firstCorner();
  const auto hasTriangle = [](uint64_t begin, uint64_t end) { return end - begin >= 3; };
  if (!first.empty() && std::adjacent_find(first.begin(), first.end(), hasTriangle) == first.end())
    throw Error(ErrorCode::EmptyMesh, "no face of the mesh has three corners; a shape diameter needs a surface");
  if (const Mesh* mesh = view.mesh()) {
    if (mesh->faces.empty())
      throw Error(ErrorCode::EmptyMesh, "the mesh has no triangles; a shape diameter needs a surface");
    return *mesh;
  }
  TriangleMesh triangles;
  const size_t vertexCount = view.vertexCount();
  if (view.floats().empty()) {
    triangles.vertices = {reinterpret_cast<const Vec3d*>(view.doubles().data()), vertexCount};
  } else {
    storage.vertices.resize(vertexCount);
    for (size_t v = 0; v < vertexCount; ++v)
      for (size_t axis = 0; axis < 3; ++axis)
        storage.vertices[v][axis] = static_cast<double>(view.floats()[3 * v + axis]);
    triangles.vertices = storage.vertices;
  }
  if (view.firstCorner().empty()) {
    triangles.faces = {reinterpret_cast<const Face*>(view.corners().data()), view.corners().size() / 3};
    return triangles;
  }
  InputFaces faces;
  faces.reserve(view.inputFaceCount());
  for (uint64_t i = 0; i < view.inputFaceCount(); ++i)
    faces.add(view.corners().subspan(view.firstCorner()[i], view.firstCorner()[i + 1] - view.firstCorner()[i]));
  faces.moveTo(triangles.vertices, storage);
  const TriangleMesh stored = storage;
  triangles.faces = stored.faces;
  triangles.polygons = stored.polygons;
  return triangles;
}

namespace {

// Largest allowed spacing of doubles at the greatest coordinate, in bounding-box diagonals. The spacing is about the
// rounding error of barycentres; the backends agree within ten times this error.
constexpr double kMaxSpacing = kAgreementTolerance / 10;

// The greatest step of float32 coordinates without a warning, in bounding-box diagonals.
constexpr double kMaxFloat32StepShare = 1e-5;

/// reverse(): reverses faces of prepared.storage.
template <typename Reverse>
void reverseFaces(PreparedMesh& prepared, const Reverse& reverse) {
  ownArrays(prepared);
  const std::vector<Face> before = prepared.storage.faces;
  reverse();
  prepared.mesh = prepared.storage;
  std::vector<uint64_t> reversed, all;
  for (uint32_t f = 0; f < prepared.mesh.faceCount(); ++f) {
    const uint32_t inputFace = prepared.mesh.inputFaceOf(f);
    if (before[f] != prepared.mesh.faces[f] && (reversed.empty() || reversed.back() != inputFace))
      reversed.push_back(inputFace);
  }
  // A face that is reversed twice is not reversed.
  std::set_symmetric_difference(prepared.reversedFaces.begin(), prepared.reversedFaces.end(), reversed.begin(),
                                reversed.end(), std::back_inserter(all));
  prepared.reversedFaces = std::move(all);
}

/// Surveys the edges. Reverses faces that are wound against their neighbours, if requested, and welds vertices.
SurfaceEdges closeSurface(PreparedMesh& prepared, Orientation orientation) {
  const Normalization unit = normalizationOf(prepared.geometry.bounds);
  SurfaceEdges edges = surveySurface(prepared.mesh, unit);
  if (orientation == Orientation::Auto && edges.survey.countOf(EdgeKind::Inconsistent) > 0) {
    TriangleMesh welded = prepared.mesh;
    if (!edges.faces.empty()) welded.faces = edges.faces;
    const std::vector<uint8_t> isTurned = findTurnedFaces(welded, unit, edges);
    if (const auto count = std::count(isTurned.begin(), isTurned.end(), 1); count > 0) {
      reverseFaces(prepared, [&] { flipFaces(prepared.storage, prepared.geometry, isTurned); });
      prepared.warnings.push_back(facesReversed(prepared.reversedFaces.size()));
      edges = surveySurface(prepared.mesh, unit);
    }
  }
  prepared.hasTJunctions = edges.hasTJunctions;
  if (edges.faces.empty()) return edges;
  prepared.storage.faces = std::move(edges.faces);
  prepared.mesh.faces = prepared.storage.faces;
  prepared.vertexOf = std::move(edges.vertexOf);
  if (edges.weldDistance > 0) prepared.geometry = computeFaceGeometry(prepared.mesh);
  return edges;
}

void orient(PreparedMesh& prepared, Orientation orientation) {
  if (orientation == Orientation::Flip)
    reverseFaces(prepared, [&] { flipAllFaces(prepared.storage, prepared.geometry, prepared.components); });
  OrientationReport report = analyseOrientation(prepared.mesh, prepared.components);
  const size_t count = report.invertedComponents.size();
  if (count == 0) return;
  if (orientation == Orientation::Auto) {
    reverseFaces(prepared, [&] { orientOutward(prepared.storage, prepared.geometry, prepared.components, report); });
    prepared.warnings.push_back(componentsReversed(count));
  } else {
    prepared.warnings.push_back({WarningCode::InvertedComponents,
                                 report.sentence(prepared.mesh, prepared.components),
                                 {{"count", std::to_string(count)}}});
    prepared.invertedComponents = std::move(report.invertedComponents);
  }
}

/// Throws Error{FarFromOrigin} if neighbouring doubles are so far apart at the coordinates that barycentres and normals
/// would be wrong.
void requireResolved(const Box3d& bounds) {
  double largest = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(bounds.min[axis]), std::abs(bounds.max[axis])});
  const double spacing = largest - std::nextafter(largest, 0.0), diagonal = bounds.diagonal();
  if (spacing <= kMaxSpacing * diagonal) return;
  throw Error(ErrorCode::FarFromOrigin,
              fmt::format("the mesh is too far from the origin: double precision resolves its coordinates of up to "
                          "{:.3g} to {:.2g}, and its bounding box has a diagonal of {:.3g}; move it to the origin",
                          largest, spacing, diagonal));
}

}  // namespace

void ownArrays(PreparedMesh& prepared) {
  const TriangleMesh mesh = prepared.mesh;
  const auto copy = [](auto& target, const auto& source) {
    if (target.data() != source.data()) target.assign(source.begin(), source.end());
  };
  copy(prepared.storage.vertices, mesh.vertices);
  copy(prepared.storage.faces, mesh.faces);
  copy(prepared.storage.polygons.firstCorner, mesh.polygons.firstCorner);
  copy(prepared.storage.polygons.corners, mesh.polygons.corners);
  copy(prepared.storage.polygons.inputFaceOf, mesh.polygons.inputFaceOf);
}

PreparedMesh prepareMesh(const MeshView& view, Orientation orientation, StageClock& clock, const RunControl& control) {
  const auto scope = clock.time(Stage::Geometry);
  PreparedMesh prepared;
  control.checkpoint(0);
  prepared.mesh = trianglesOf(view, prepared.storage);
  const TriangleMesh& mesh = prepared.mesh;
  control.checkpoint(0);
  prepared.geometry = computeFaceGeometry(mesh);
  control.checkpoint(0);
  SurfaceEdges surface = [&] {
    const auto graphScope = clock.time(Stage::Graph);
    return closeSurface(prepared, orientation);
  }();
  EdgeSurvey& edges = surface.survey;
  control.checkpoint(0);
  prepared.representatives = coincidentRepresentatives(mesh, edges);
  control.checkpoint(0);
  prepared.components = findComponents(mesh, edges);
  control.checkpoint(0);
  prepared.defects = findDefects(mesh, prepared.geometry, prepared.representatives, edges);
  prepared.defects.weldedVertexCount = surface.weldedVertexCount;
  prepared.defects.unreferencedVertexCount -= surface.weldedVertexCount;
  prepared.graph = std::move(edges.graph);
  prepared.openEdges = edges.edges;
  std::vector<Warning> warnings = warningsOf(prepared.defects, !mesh.polygons.isEmpty());
  prepared.warnings.insert(prepared.warnings.begin(), warnings.begin(), warnings.end());
  if (const Mesh* const source = view.mesh()) {
    prepared.unit = source->unit;
    prepared.chordError = source->chordError;
    prepared.objects = source->objects;
    prepared.statedPartCount = source->statedPartCount;
    if (!source->skipped.empty()) prepared.warnings.push_back(skippedContent(source->skipped));
    prepared.negativeVolumeCount = source->negativeVolumeCount;
    if (prepared.negativeVolumeCount > 0) prepared.warnings.push_back(negativeVolumes(prepared.negativeVolumeCount));
  }
  prepared.float32Step = float32StepOf(mesh.vertices);
  if (view.mesh() != nullptr) prepared.float32Step = std::max(prepared.float32Step, view.mesh()->float32Step);
  if (const double share = prepared.float32Step / prepared.geometry.bounds.diagonal(); share > kMaxFloat32StepShare)
    prepared.warnings.push_back(coarseCoordinates(prepared.float32Step, share));
  control.checkpoint(0);
  orient(prepared, orientation);
  prepared.traceableFaces =
      indicesInParallel(mesh.faceCount(), [&](uint32_t face) { return !prepared.geometry.isDegenerate(face); });
  if (!prepared.traceableFaces.empty()) requireResolved(prepared.geometry.bounds);
  return prepared;
}

PreparedMesh prepareMesh(const MeshView& mesh, Orientation orientation) {
  StageSeconds seconds;
  StageClock clock(seconds);
  return prepareMesh(mesh, orientation, clock, {});
}

}  // namespace asdfvk
