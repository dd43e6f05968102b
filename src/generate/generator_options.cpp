#include "generate/generator_options.h"

#include <fmt/core.h>

#include "asdf_vk/version.h"
#include "core/text.h"
#include "generate/shapes.h"
#include "generate/thickness_parts.h"

namespace asdfvk {

void addOptions(ArgumentParser& parser, GeneratorOptions& options) {
  parser.setProgram("asdf-vk-generate",
                    "Generates closed triangle meshes as binary PLY: shapes whose parts and local diameters are "
                    "known, and mechanical parts whose least wall thickness is known.");
  parser.addVersion(fmt::format("asdf-vk-generate {} ({})", ASDFVK_VERSION, ASDFVK_COMMIT));
  parser
      .addValue("shape", "SHAPE",
                fmt::format("One of {}; or a part: {}", joined(shapeNames(), ", "), joined(thicknessPartNames(), ", ")),
                [&](const std::string& text) { options.shape = text; })
      .completions(joined(shapeNames(), "|") + "|" + joined(thicknessPartNames(), "|"))
      .require();
  parser
      .addValue("-o,--output", "FILE.ply|-", "The PLY file to write; - is standard output",
                [&](const std::string& text) { options.output = text; })
      .require();
  parser.addNumber(
      "--faces", "N",
      fmt::format("Approximate number of faces; default {}; of a shape of known diameter", options.faceCount),
      options.faceCount);
  parser.addNumber("--longest-edge", "L",
                   "Divide the edges of a part until they are at most this long, before the scaling; default: as few "
                   "faces as possible",
                   options.longestEdge);
  parser.addNumber("--scale", "S", fmt::format("Factor on all lengths; default {}", options.scale), options.scale);
  parser.addNumbers("--translate", "X Y Z", "Shift, after the scaling", options.translate);
  parser.addFlag("--double", options.doubleVertices, "Write vertices as double instead of float");
}

}  // namespace asdfvk
