#pragma once

#include <cstdint>
#include <utility>

#include "mesh/mesh.h"
#include "pipeline/prepared_scene.h"
#include "pipeline/stage_clock.h"

namespace asdfvk {

/// A closed torus with bumps, which has values of many sizes, and 2 * longCount * shortCount faces.
[[nodiscard]] Mesh bumpyTorus(uint32_t longCount, uint32_t shortCount);

/// A closed ring of 768 faces. One half is a bumpy torus; the other half has a square section, with sharp edges and
/// with coplanar faces in axis-aligned planes.
[[nodiscard]] Mesh halfSquareRing();

/// A generated mesh, prepared for tracers. The outcome of a test of a device on it does not depend on the meshes of the
/// user.
struct GeneratedMesh {
  explicit GeneratedMesh(Mesh generated) : mesh(std::move(generated)) {}

  Mesh mesh;
  StageSeconds seconds;
  StageClock clock{seconds};
  PreparedScene scene{mesh, Orientation::Keep, clock, {}};
};

}  // namespace asdfvk
