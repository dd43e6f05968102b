#pragma once

#include <cstdint>
#include <utility>

#include "mesh/mesh.h"
#include "pipeline/prepared_scene.h"
#include "pipeline/stage_clock.h"

namespace asdfvk {

/// A torus with bumps: closed, with values of many sizes. Of 2 longCount shortCount faces.
[[nodiscard]] Mesh bumpyTorus(uint32_t longCount, uint32_t shortCount);

/// A closed ring of 768 faces, half of it a bumpy torus, half with a square section: sharp edges, and coplanar faces in
/// planes of the axes.
[[nodiscard]] Mesh halfSquareRing();

/// A generated mesh, prepared for tracers: tests of a device on it have the same outcome whatever the meshes of the
/// user are.
struct GeneratedMesh {
  explicit GeneratedMesh(Mesh generated) : mesh(std::move(generated)) {}

  Mesh mesh;
  StageSeconds seconds;
  StageClock clock{seconds};
  PreparedScene scene{mesh, Orientation::Keep, clock, {}};
};

}  // namespace asdfvk
