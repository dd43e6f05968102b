#include "pipeline/prepared_mesh.h"

#include <fmt/format.h>

#include <utility>

#include "asdf_vk/error.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "mesh/coincident_faces.h"
#include "mesh/orientation.h"

namespace asdfvk {
namespace {

void orient(Mesh& mesh, PreparedMesh& prepared, Orientation orientation) {
  if (orientation == Orientation::Flip) flipAllFaces(mesh, prepared.geometry, prepared.components);
  OrientationReport report = analyseOrientation(mesh, prepared.components);
  const size_t invertedCount = report.invertedComponents.size();
  if (invertedCount == 0) return;
  if (orientation == Orientation::Auto) {
    orientOutward(mesh, prepared.geometry, prepared.components, report);
    prepared.warnings.push_back(
        fmt::format("{} inverted component{} turned over", invertedCount, invertedCount == 1 ? " was" : "s were"));
  } else {
    prepared.warnings.push_back(report.sentence(mesh, prepared.components));
    prepared.invertedComponents = std::move(report.invertedComponents);
  }
}

}  // namespace

PreparedMesh prepareMesh(Mesh& mesh, Orientation orientation, StageSeconds& seconds) {
  const Stopwatch watch;
  if (mesh.inputFaceCount() == 0)
    throw Error(ErrorCode::EmptyMesh, "the mesh has no faces; a shape diameter needs a surface");
  if (const uint64_t count = countFacesWithIndexOutOfRange(mesh); count > 0)
    throw Error(ErrorCode::IndexOutOfRange, fmt::format("{} with a vertex that does not exist: the mesh has {}",
                                                        counted(count, mesh.polygons.isEmpty() ? "face" : "triangle"),
                                                        counted(mesh.vertices.size(), "vertex", "vertices")));
  PreparedMesh prepared;
  prepared.geometry = computeFaceGeometry(mesh);
  const Stopwatch graphWatch;
  EdgeSurvey edges = surveyEdges(mesh);
  const double graphSeconds = graphWatch.seconds();
  prepared.representatives = coincidentRepresentatives(mesh, edges);
  prepared.components = findComponents(mesh, edges);
  prepared.defects = findDefects(mesh, prepared.geometry, prepared.representatives, edges);
  prepared.graph = std::move(edges.graph);
  prepared.warnings = prepared.defects.sentences();
  orient(mesh, prepared, orientation);
  prepared.castableFaces.reserve(mesh.faces.size());
  for (uint32_t face = 0; face < mesh.faceCount(); ++face)
    if (!prepared.geometry.isDegenerate(face)) prepared.castableFaces.push_back(face);
  seconds.graph += graphSeconds;
  seconds.geometry += watch.seconds() - graphSeconds;
  return prepared;
}

}  // namespace asdfvk
