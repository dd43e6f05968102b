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
  ArgumentParser parser;
  parser.setProgram("asdfvk-random-solid", "Random solids without a known diameter.");
  parser.addValue("solid", "SOLID", "assembly or doubled", [&](const std::string& text) { solid = text; }).require();
  parser.addValue("-o,--output", "FILE.ply", "The file to write", [&](const std::string& text) { output = text; })
      .require();
  parser.addNumber("--rng-seed", "N", "Another solid", parameters.seed);
  parser.addNumber("--apart", "DISTANCE", "Move the parts of an assembly apart: no contacts", apart);
  parser.addFlag("--interpenetrate", parameters.interpenetrates, "Let parts of an assembly overlap");
  parser.addFlag("--double", doubleVertices, "Write vertices as double");
  try {
    const ParseResult result = parser.parse({argv + 1, argv + argc});
    if (!result.refusal.empty() || !result.answer.empty() || (solid != "assembly" && solid != "doubled")) {
      fmt::print(stderr, "{}{}\n", result.refusal, result.answer);
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
