#include "generate/generator_options.h"

#include <fmt/core.h>

#include "asdf_vk/version.h"
#include "core/text.h"
#include "generate/shapes.h"
#include "generate/thickness_parts.h"

namespace asdfvk {

ArgumentParser parserOf(GeneratorOptions& options) {
  std::vector<Argument> arguments{
      {"shape", "SHAPE",
       fmt::format("One of {}; or a part: {}", joined(shapeNames(), ", "), joined(thicknessPartNames(), ", ")),
       into(options.shape)},
      {"-o,--output", "FILE.ply|-", "The PLY file to write; - is standard output", into(options.output)},
      {"--corpus", "FOLDER",
       "Write all parts of known truth, and truth.json with the right verdicts, to a new or empty folder",
       into(options.corpus)},
      {"--faces", "N",
       fmt::format("Approximate number of faces of a shape of known diameter; default {}", options.faceCount),
       into(options.faceCount)},
      {"--longest-edge", "L",
       "Divide the edges of a part until they are at most this long, before the scaling; default: as few faces as "
       "possible",
       into(options.longestEdge)},
      {"--scale", "S", fmt::format("Factor on all lengths; default {}", options.scale), into(options.scale)},
      {"--translate", "X Y Z", "Shift, after the scaling", into(options.translate)},
      {"--double", "", "Write vertices as double instead of float", into(options.doubleVertices)}};
  for (Argument& argument : arguments)
    if (argument.names == "--translate") argument.valueCount = options.translate.size();
  return ArgumentParser(
      "asdf-vk-generate",
      "Generates closed triangle meshes as binary PLY: shapes whose parts and local diameters are known, and "
      "mechanical parts whose least wall thickness is known.",
      fmt::format("asdf-vk-generate {} ({})", ASDFVK_VERSION, ASDFVK_COMMIT), std::move(arguments));
}

}  // namespace asdfvk
