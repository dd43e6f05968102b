#pragma once

#include <cstdint>
#include <vector>

#include "generate/extrusion.h"
#include "mesh/mesh.h"

/// Solids with as few faces as possible, and how they are combined and damaged.
namespace asdfvk::solids {

/// A box with 12 faces; faces 2 k and 2 k + 1 are a side, in the order -x, +x, -y, +y, -z, +z.
Mesh box(const Vec3d& min, const Vec3d& max);
/// A prism along z over a regular polygon, whose first corner is at +x.
Mesh regularPrism(uint32_t sideCount, double radius, double bottom, double top);
/// A tube along z between two regular polygons whose sides are parallel. The radii are those of the corners; the inner
/// radius can differ at the top. The outer ends are at the bottom and at the top of the inner ones.
Mesh tube(uint32_t sideCount, double innerBottom, double innerTop, double outer, double bottom, double top);
/// A cone along z over a regular polygon at z = 0, with its tip at the top.
Mesh cone(uint32_t sideCount, double radius, double height);
/// A geodesic sphere; all vertices are at the radius.
Mesh ball(const Vec3d& centre, double radius, uint32_t faceCount = 1280);

/// All faces, each mesh with its own vertices.
Mesh joined(const std::vector<Mesh>& meshes);
/// Each face with the other winding.
Mesh inverted(Mesh mesh);
Mesh moved(Mesh mesh, const Vec3d& shift);
Mesh scaled(Mesh mesh, double factor);
/// Three vertices of its own for each face.
Mesh separated(const Mesh& mesh);
/// One vertex per position.
Mesh welded(Mesh mesh);
/// Without the faces from `first` on, at most `count`.
Mesh without(Mesh mesh, size_t first, size_t count);

}  // namespace asdfvk::solids
