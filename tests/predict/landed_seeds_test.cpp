#include "predict/landed_seeds.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "generate/shapes.h"
#include "predict/seeded_mesh.h"

using namespace asdfvk;
using test::SeededMesh;

TEST_CASE("a seed has landed in the cells of the faces that its kept rays hit, but not in its own") {
  // Of the second sphere no face is a seed: what lands there is in no cell.
  for (const Mesh& mesh :
       {makeAnimal(2000).mesh, test::joined(makeTorus(900).mesh, makeSphere(80).mesh, {0.2, 0, 0})}) {
    const SeededMesh seeded(mesh, 40);
    const SeedCells cells = seeded.cells();
    const Buckets<uint32_t> landed = landedSeeds(seeded.cone, seeded.scene(), seeded.traced(), cells);
    REQUIRE(landed.bucketCount() == 40);
    const size_t rayCount = seeded.cone.directions.size();
    std::vector<std::set<uint32_t>> expected(40);
    for (uint32_t seed = 0; seed < 40; ++seed) {
      const LengthWindow window = keptLengths(seeded.scene(), seeded.cone, seeded.traced(), seed);
      for (size_t ray = 0; ray < rayCount; ++ray) {
        const ConeHit& hit = seeded.hits[seed * rayCount + ray];
        if (hit.face == kNoFace || cells.cellOf[hit.face] == kNoCell || cells.cellOf[hit.face] == seed) continue;
        const double facing = dot(seeded.geometry.normals[seeded.seeds[seed]], seeded.geometry.normals[hit.face]);
        if (facing > seeded.cone.falseHitCosine) continue;
        if (window.keeps(static_cast<double>(hit.distance))) expected[cells.cellOf[hit.face]].insert(seed);
      }
    }
    size_t count = 0;
    for (uint32_t cell = 0; cell < 40; ++cell) {
      CHECK(std::equal(landed[cell].begin(), landed[cell].end(), expected[cell].begin(), expected[cell].end()));
      count += expected[cell].size();
    }
    CHECK(count > 40);
  }
}
