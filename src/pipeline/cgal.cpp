#include "asdf_vk/cgal.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "asdf_vk/error.h"
#include "describe/computation_options.h"
#include "mesh/face_geometry.h"
#include "pipeline/input_face_values.h"
#include "pipeline/prepared_mesh.h"
#include "segment/cgal_postprocess.h"
#include "segment/cgal_segmentation.h"

namespace asdfvk {
namespace {

/// Values of triangles (#F) from values of input faces. Throws Error{ValueOutOfRange} for a value for which
/// isValid(value) is false. allowed: the allowed values, for the message.
template <typename IsValid>
std::vector<double> valuesOfTriangles(const TriangleMesh& mesh, std::span<const double> values, const char* allowed,
                                      const IsValid& isValid) {
  if (values.size() != mesh.inputFaceCount())
    throw Error(ErrorCode::ArraySize, fmt::format("{} values for {} faces; one value per face is needed", values.size(),
                                                  mesh.inputFaceCount()));
  std::vector<double> ofTriangles(mesh.faceCount());
  for (uint32_t face = 0; face < mesh.faceCount(); ++face) {
    const uint32_t inputFace = mesh.inputFaceOf(face);
    ofTriangles[face] = values[inputFace];
    if (!isValid(ofTriangles[face]))
      throw Error(ErrorCode::ValueOutOfRange,
                  fmt::format("the value {} of face {} is out of range ({})", ofTriangles[face], inputFace, allowed));
  }
  return ofTriangles;
}

}  // namespace

PostprocessedSdf postprocessSdf(const MeshView& view, std::span<const double> values, const RunControl& control) {
  control.checkpoint(0);
  Mesh storage;
  const TriangleMesh mesh = trianglesOf(view, storage);
  const std::vector<double> ofTriangles =
      valuesOfTriangles(mesh, values, "0 or more and finite, or NaN for no value",
                        [](double value) { return std::isnan(value) || (value >= 0 && std::isfinite(value)); });
  CgalValues result = postprocessLikeCgal(findFaceNeighbours(mesh), ofTriangles, control);
  if (!mesh.polygons.isEmpty())
    result.normalized = valuesOfInputFaces(mesh, std::move(result.normalized), computeFaceGeometry(mesh).areas);
  control.checkpoint(1);
  return {std::move(result.normalized), result.min, result.max};
}

LabelledFaces segmentSdf(const MeshView& view, std::span<const double> values, const CgalSegmentationOptions& options,
                         CgalLabels labels, const RunControl& control) {
  Options checked;
  checked.segmentation = Segmentation::Cgal;
  checked.cgalSegmentation = options;
  (void)CheckedOptions(checked);
  control.checkpoint(0);
  Mesh storage;
  const TriangleMesh mesh = trianglesOf(view, storage);
  const std::vector<double> ofTriangles =
      valuesOfTriangles(mesh, values, "0 to 1, or NaN for no value",
                        [](double value) { return std::isnan(value) || (value >= 0 && value <= 1); });
  const FaceGeometry geometry = computeFaceGeometry(mesh);
  const FaceNeighbours neighbours = findFaceNeighbours(mesh);
  control.checkpoint(0);
  const CgalSegmentation segmentation = segmentLikeCgal(
      geometry, mesh, neighbours, fillMissingValues(neighbours, ofTriangles), options, control.withoutProgress());
  control.checkpoint(1);
  if (labels == CgalLabels::Clusters)
    return {labelsOfInputFaces(mesh, segmentation.clusters, geometry.areas), options.clusterCount};
  LabelledFaces result{segmentsOfInputFaces(mesh, segmentation.segments, geometry.areas), 0};
  result.count = countSegments(result.labels);
  return result;
}

}  // namespace asdfvk
