#include <chrono>
#include <csignal>
#include <filesystem>
#include <span>
#include <sstream>
#include <thread>

#include "cli/lavapipe.h"
#include "cli/mesh_tree.h"
#include "core/random.h"
#include "support/shapes.h"

namespace asdfvk::test {
namespace {

std::string offOf(const Mesh& mesh) {
  std::ostringstream out;
  out.precision(17);
  out << "OFF\n" << mesh.vertices.size() << " " << mesh.faces.size() << " 0\n";
  for (const Vec3d& v : mesh.vertices) out << v.x << " " << v.y << " " << v.z << "\n";
  for (const auto& [a, b, c] : mesh.faces) out << "3 " << a << " " << b << " " << c << "\n";
  return out.str();
}

/// Meshes on which devices and the reference differ, or nearly: coincident, coplanar and touching faces, open and
/// degenerate meshes.
Names writeAwkwardMeshes(const ScratchFolder& folder) {
  const Mesh plate = shapes::box({4, 4, 1}, 8);
  Mesh flat = shapes::cube();
  flat.faces.insert(flat.faces.end(), {{0, 0, 1}, {0, 3, 3}});
  return {folder.write("double.off", offOf(shapes::doubledCube())),
          folder.write("touch.off", offOf(shapes::joined(plate, shapes::box({2, 2, 1}, 5), {0, 0, 1}))),
          folder.write("gap.off", offOf(shapes::joined(plate, plate, {0, 0, 1.1}))),
          folder.write("twice.off", offOf(shapes::joined(plate, plate))),
          folder.write("open.off", offOf(shapes::openBox({1, 2, 3}, 4))),
          folder.write("sheet.off", offOf(shapes::grid(6))),
          folder.write("flat.off", offOf(flat)),
          folder.write("soup.off", offOf(shapes::soup(60, 1))),
          folder.write("torus.off", offOf(shapes::torus(2, 0.5, 60, 30))),
          folder.write("sphere.off", sphereOff(20))};
}

Names shuffled(Names names, uint64_t seed) {
  Random(seed).shuffle(std::span(names));
  return names;
}

TEST_CASE("results depend neither on the order of a batch, nor on --jobs, nor on an interruption") {
  const auto lavapipe = lavapipeOnly();
  if (!lavapipe) return;
  const ScratchFolder folder;
  const Names meshes = writeAwkwardMeshes(folder);
  const auto argumentsOf = [&](const Names& inputs, const std::string& out, const Names& more) {
    Names arguments = inputs;
    arguments.insert(arguments.end(), {"-o", folder / out + "/", "--format", "npy", "--log", folder / out + ".jsonl"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const auto run = [&](const Names& inputs, const std::string& out, const Names& more) {
    const ChildOutcome outcome = runAsdf(argumentsOf(inputs, out, more), *lavapipe);
    INFO(outcome.error);
    CHECK(outcome.error.find("wrong") == std::string::npos);
    return resultsIn(folder / out);
  };
  const Names vulkan{"--backend", "vulkan", "--seeds", "30%"};
  const auto with = [&](const Names& more) {
    Names all = vulkan;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const auto expected = run(meshes, "first", with({"--jobs", "1"}));
  CHECK_EQ(expected.size(), meshes.size());
  for (uint64_t seed = 1; seed <= 2; ++seed)
    CHECK(run(shuffled(meshes, seed), "jobs" + std::to_string(seed), with({"--jobs", "2"})) == expected);
  CHECK(run(shuffled(meshes, 3), "auto", {"--backend", "auto", "--seeds", "30%"}) == expected);

  ChildProcess child(ASDFVK_PROGRAM, argumentsOf(shuffled(meshes, 4), "resumed", with({"--jobs", "1"})), *lavapipe);
  const std::string log = folder / "resumed.jsonl";
  for (int i = 0; i < 1000 && (!std::filesystem::exists(log) || recordsIn(log).size() < 3); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  child.send(SIGTERM);
  (void)child.finish(60);
  CHECK(run(shuffled(meshes, 5), "resumed", with({"--skip-existing"})) == expected);
}

}  // namespace
}  // namespace asdfvk::test
