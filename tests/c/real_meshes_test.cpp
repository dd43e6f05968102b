#include <doctest/doctest.h>

#include "asdf_vk/files.h"
#include "asdf_vk/session.h"
#include "c/c_objects.h"
#include "support/bits.h"
#include "support/real_meshes.h"

using namespace asdfvk;
using namespace asdfvk::test;

TEST_CASE("files of real meshes have the values of the library") {
  const auto folder = realMeshFolder();
  if (!folder) return;
  const Owned<asdf_vk_session> own = sessionOfC("cpu");
  Session session({.backend = BackendChoice::Cpu});
  for (const char* name : {"horse-10k.off", "fandisk.off", "elephant.obj"}) {
    CAPTURE(name);
    const std::string path = (*folder / "models" / name).string();
    const Result expected = session.compute(readMesh(path));
    asdf_vk_scene* handle = nullptr;
    requireDone(asdf_vk_scene_read(own.get(), path.c_str(), &handle));
    const Owned<asdf_vk_scene> scene(handle);
    const Owned<asdf_vk_result> result = resultOfC(scene.get());
    CHECK(haveSameBits(numbersOf(result.get(), "sdf"), expected.sdf()));
  }
}
