#include "baselines.h"

#ifdef ASDFVK_HAS_CGAL
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/mesh_segmentation.h>
#endif

#include "core/stopwatch.h"

namespace asdfvk::bench {

#ifdef ASDFVK_HAS_CGAL
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

}  // namespace

bool hasCgal() { return true; }

std::optional<double> cgalSeconds(const Mesh& mesh) {
  namespace processing = CGAL::Polygon_mesh_processing;
  if (!processing::is_polygon_soup_a_polygon_mesh(mesh.faces)) return {};
  std::vector<Kernel::Point_3> points;
  for (const Vec3d& v : mesh.vertices) points.emplace_back(v.x, v.y, v.z);
  SurfaceMesh surface;
  processing::polygon_soup_to_polygon_mesh(points, mesh.faces, surface);
  auto values = surface.add_property_map<SurfaceMesh::Face_index, double>("f:sdf").first;
  constexpr double kConeAngle = 2.0 / 3.0 * CGAL_PI;
  constexpr size_t kRayCount = 30;
  const Stopwatch watch;
  CGAL::sdf_values(surface, values, kConeAngle, kRayCount, false);
  return watch.seconds();
}

#else
bool hasCgal() { return false; }

std::optional<double> cgalSeconds(const Mesh&) { return {}; }
#endif

}  // namespace asdfvk::bench
