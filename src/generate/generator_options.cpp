#include "generate/generator_options.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "asdf_vk/version.h"
#include "generate/shapes.h"

namespace asdfvk {

void addOptions(CLI::App& app, GeneratorOptions& options) {
  app.name("asdf-vk-generate");
  app.description("Generates closed triangle meshes whose parts and local diameters are known, as binary PLY.");
  app.set_version_flag("--version", fmt::format("asdf-vk-generate {} ({})", ASDFVK_VERSION, ASDFVK_COMMIT),
                       "Print the version");
  app.add_option("shape", options.shape, fmt::format("One of {}", fmt::join(shapeNames(), ", ")))
      ->option_text("SHAPE")
      ->type_name(fmt::format("{}", fmt::join(shapeNames(), "|")))
      ->required();
  app.add_option("-o,--output", options.output, "The PLY file to write; - is standard output")
      ->option_text("FILE.ply|-")
      ->required();
  app.add_option("--faces", options.faceCount,
                 fmt::format("Approximate number of faces; default {}", options.faceCount))
      ->option_text("N");
  app.add_option("--scale", options.scale, fmt::format("Factor on all lengths; default {}", options.scale))
      ->option_text("S");
  app.add_option("--translate", options.translate, "Shift, after the scaling")->option_text("X Y Z");
  app.add_flag("--double", options.doubleVertices, "Write vertices as double instead of float");
}

}  // namespace asdfvk
