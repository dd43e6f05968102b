#include "io/opencascade/deviation.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <limits>

namespace asdfvk {
namespace {

/// Distance of a point from a surface, by Newton's method from the parameters `place`.
double distanceFrom(const BRepAdaptor_Surface& surface, gp_XY place, const gp_XYZ& point) {
  constexpr int kStepCount = 3;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kStepCount; ++i) {
    gp_Pnt on;
    gp_Vec u, v;
    surface.D1(place.X(), place.Y(), on, u, v);
    const gp_Vec way(on, gp_Pnt(point));
    least = std::min(least, way.Magnitude());
    const double uu = u.Dot(u), uv = u.Dot(v), vv = v.Dot(v), determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-12 * uu * vv)) break;  // At the pole of a sphere, for example.
    place += gp_XY(vv * u.Dot(way) - uv * v.Dot(way), uu * v.Dot(way) - uv * u.Dot(way)) / determinant;
  }
  return least;
}

}  // namespace

double deviationOf(const TopoDS_Face& face, double enough) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, location);
  const BRepAdaptor_Surface surface(face, false);
  if (triangles.IsNull() || !triangles->HasUVNodes() || surface.GetType() == GeomAbs_Plane) return 0;
  double greatest = 0;
  for (int i = 1; i <= triangles->NbTriangles(); ++i) {
    int corners[3];
    triangles->Triangle(i).Get(corners[0], corners[1], corners[2]);
    gp_XYZ points[3];
    gp_XY places[3];
    for (int c = 0; c < 3; ++c) {
      points[c] = triangles->Node(corners[c]).Transformed(location.Transformation()).XYZ();
      places[c] = triangles->UVNode(corners[c]).XY();
    }
    const auto check = [&](const gp_XY& place, const gp_XYZ& point) {
      double least = distanceFrom(surface, place, point);
      for (int c = 0; c < 3 && least > enough; ++c) least = std::min(least, distanceFrom(surface, places[c], point));
      greatest = std::max(greatest, least);
    };
    check((places[0] + places[1] + places[2]) / 3, (points[0] + points[1] + points[2]) / 3);
    for (int c = 0; c < 3; ++c) check((places[c] + places[(c + 1) % 3]) / 2, (points[c] + points[(c + 1) % 3]) / 2);
  }
  return greatest;
}

}  // namespace asdfvk
