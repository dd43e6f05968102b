#include "support/cgal_oracle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/mesh_segmentation.h>

#include <cmath>

#include "core/check.h"

namespace asdfvk::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using FaceIndex = SurfaceMesh::Face_index;

}  // namespace

struct CgalOracle::Surface {
  SurfaceMesh mesh;
  SurfaceMesh::Property_map<FaceIndex, double> values;
  SurfaceMesh::Property_map<FaceIndex, std::size_t> segments;

  void setValues(std::span<const double> numbers) {
    for (const FaceIndex face : mesh.faces()) values[face] = std::isnan(numbers[face]) ? -1 : numbers[face];
  }
};

CgalOracle::CgalOracle(const Mesh& mesh) : surface_(std::make_unique<Surface>()) {
  namespace processing = CGAL::Polygon_mesh_processing;
  std::vector<Kernel::Point_3> points;
  for (const Vec3d& v : mesh.vertices) points.emplace_back(v.x, v.y, v.z);
  std::vector<std::vector<std::size_t>> polygons;
  for (const Face& face : mesh.faces) polygons.push_back({face[0], face[1], face[2]});
  if (!processing::is_polygon_soup_a_polygon_mesh(polygons)) processing::orient_polygon_soup(points, polygons);
  for (const Kernel::Point_3& p : points) mesh_.vertices.push_back({p.x(), p.y(), p.z()});
  for (const std::vector<std::size_t>& polygon : polygons)
    mesh_.faces.push_back(
        {static_cast<uint32_t>(polygon[0]), static_cast<uint32_t>(polygon[1]), static_cast<uint32_t>(polygon[2])});
  processing::polygon_soup_to_polygon_mesh(points, polygons, surface_->mesh);
  ASDFVK_CHECK_OP(surface_->mesh.number_of_faces(), ==, mesh.faces.size());
  surface_->values = surface_->mesh.add_property_map<FaceIndex, double>("f:value").first;
  surface_->segments = surface_->mesh.add_property_map<FaceIndex, std::size_t>("f:segment").first;
}

CgalOracle::~CgalOracle() = default;

std::vector<double> CgalOracle::rawValues() {
  constexpr double kConeAngle = 2.0 / 3.0 * CGAL_PI;
  constexpr std::size_t kRayCount = 25;
  CGAL::sdf_values(surface_->mesh, surface_->values, kConeAngle, kRayCount, false);
  std::vector<double> values;
  for (const FaceIndex face : surface_->mesh.faces())
    values.push_back(surface_->values[face] == -1 ? kNoValue : surface_->values[face]);
  return values;
}

CgalOracle::Values CgalOracle::postprocess(std::span<const double> values) {
  surface_->setValues(values);
  Values result;
  std::tie(result.min, result.max) = CGAL::sdf_values_postprocessing(surface_->mesh, surface_->values);
  for (const FaceIndex face : surface_->mesh.faces()) result.normalized.push_back(surface_->values[face]);
  return result;
}

std::vector<uint32_t> CgalOracle::segment(std::span<const double> values, uint32_t clusterCount, double smoothness,
                                          bool returnsClusters) {
  surface_->setValues(values);
  CGAL::segmentation_from_sdf_values(surface_->mesh, surface_->values, surface_->segments, clusterCount, smoothness,
                                     returnsClusters);
  std::vector<uint32_t> segments;
  for (const FaceIndex face : surface_->mesh.faces())
    segments.push_back(static_cast<uint32_t>(surface_->segments[face]));
  return segments;
}

}  // namespace asdfvk::test
