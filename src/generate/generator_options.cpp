#include "generate/generator_options.h"

#include <fmt/core.h>

#include "asdf_vk/version.h"
#include "core/text.h"
#include "generate/shapes.h"

namespace asdfvk {

void addOptions(ArgumentParser& parser, GeneratorOptions& options) {
  parser.setProgram("asdf-vk-generate",
                    "Generates closed triangle meshes whose parts and local diameters are known, as binary PLY.");
  parser.addVersion(fmt::format("asdf-vk-generate {} ({})", ASDFVK_VERSION, ASDFVK_COMMIT));
  parser
      .addValue("shape", "SHAPE", "One of " + joined(shapeNames(), ", "),
                [&](const std::string& text) { options.shape = text; })
      .completions(joined(shapeNames(), "|"))
      .require();
  parser
      .addValue("-o,--output", "FILE.ply|-", "The PLY file to write; - is standard output",
                [&](const std::string& text) { options.output = text; })
      .require();
  parser.addNumber("--faces", "N", fmt::format("Approximate number of faces; default {}", options.faceCount),
                   options.faceCount);
  parser.addNumber("--scale", "S", fmt::format("Factor on all lengths; default {}", options.scale), options.scale);
  parser.addNumbers("--translate", "X Y Z", "Shift, after the scaling", options.translate);
  parser.addFlag("--double", options.doubleVertices, "Write vertices as double instead of float");
}

}  // namespace asdfvk
