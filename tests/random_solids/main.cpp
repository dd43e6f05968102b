// asdfvk-random-solid SOLID --rng-seed N -o FILE.ply: assemblies and doubled solids for scripts/fuzz-runs.
#include <fmt/core.h>

#include <exception>
#include <string>

#include "arguments/arguments.h"
#include "random_solids/assembly.h"

int main(int argc, char** argv) {
  using namespace asdfvk;
  std::string solid, output;
  AssemblyParameters parameters;
  double apart = 0;
  bool doubleVertices = false;
  ArgumentParser parser(
      "asdfvk-random-solid", "Random solids without a known diameter.", "",
      {{.names = "solid", .placeholder = "assembly|doubled", .receive = into(solid), .isRequired = true},
       {.names = "-o,--output", .placeholder = "FILE.ply", .receive = into(output), .isRequired = true},
       {.names = "--rng-seed", .placeholder = "N", .text = "Another solid", .receive = into(parameters.seed)},
       {.names = "--apart",
        .placeholder = "DISTANCE",
        .text = "Move the parts of an assembly apart: no contacts",
        .receive = into(apart)},
       {.names = "--interpenetrate",
        .text = "Let parts of an assembly overlap",
        .receive = into(parameters.interpenetrates)},
       {.names = "--double", .text = "Write vertices as double", .receive = into(doubleVertices)}});
  try {
    const std::string answer = parser.parse({argv + 1, argv + argc});
    if (!answer.empty() || (solid != "assembly" && solid != "doubled")) {
      fmt::print(stderr, "{}\n", answer.empty() ? "solid is not assembly or doubled" : answer);
      return 1;
    }
    if (parser.isGiven("--apart")) parameters.apart = apart;
    GeneratedShape shape = solid == "doubled" ? makeDoubledSolid(parameters.seed) : makeAssembly(parameters);
    for (Vec3d& p : shape.mesh.vertices) p = p + Vec3d{};  // -0 becomes 0, as in asdf-vk-generate.
    writeGeneratedPly(output, shape, doubleVertices);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "asdfvk-random-solid: {}\n", error.what());
    return 1;
  }
}
