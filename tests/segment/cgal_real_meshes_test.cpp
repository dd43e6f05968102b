#include <filesystem>
#include <string>

#include "asdf_vk/files.h"
#include "cgal_comparison.h"
#include "support/real_meshes.h"

using namespace asdfvk;

TEST_CASE("real meshes, open and closed: values and segments of CGAL") {
  const auto folder = test::realMeshFolder();
  if (!folder) return;
  for (const std::string& name : std::vector<std::string>{"open/decimated-knight.off", "open/elephant-with-holes.off",
                                                          "open/suzanne.obj", "open/teapot.obj", "models/cow.off"}) {
    CAPTURE(name);
    test::checkAgainstCgal(readMesh(*folder / name));
  }
}
