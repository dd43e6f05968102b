#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <string>

#include "asdf_vk/error.h"
#include "generate/generated_shape.h"
#include "generate/shapes.h"

namespace {

using namespace asdfvk;

constexpr int kUsageExit = 1;
constexpr int kOutputExit = 4;

struct Options {
  std::string shape, output;
  uint64_t faceCount = 20000;
  double scale = 1;
  std::array<double, 3> translate{0, 0, 0};
  bool doubleVertices = false;
};

void place(GeneratedShape& shape, const Options& options) {
  const Vec3d shift{options.translate[0], options.translate[1], options.translate[2]};
  for (Vec3d& p : shape.mesh.vertices) p = p * options.scale + shift;
  for (float& diameter : shape.diameter) diameter = static_cast<float>(diameter * options.scale);
}

void run(const Options& options) {
  if (!(options.scale > 0) || !std::isfinite(options.scale))
    throw Error(ErrorCode::OptionOutOfRange, "--scale must be a positive number");
  GeneratedShape shape = generateShape(options.shape, options.faceCount);
  place(shape, options);
  writeGeneratedPly(options.output, shape, options.doubleVertices);
  fmt::print(stderr, "{}: {} with {} faces, {} vertices\n", options.output, options.shape, shape.mesh.faces.size(),
             shape.mesh.vertices.size());
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Generates closed triangle meshes whose parts and local diameters are known, as binary PLY.",
               "asdf-vk-generate");
  app.add_option("shape", options.shape, fmt::format("One of {}", fmt::join(shapeNames(), ", ")))->required();
  app.add_option("-o,--output", options.output, "The PLY file to write; - is standard output")->required();
  app.add_option("--faces", options.faceCount, "Approximate number of faces")->capture_default_str();
  app.add_option("--scale", options.scale, "Factor on all lengths")->capture_default_str();
  app.add_option("--translate", options.translate, "Shift by X Y Z, after the scaling");
  app.add_flag("--double", options.doubleVertices, "Write vertices as double instead of float");
  try {
    app.parse(argc, argv);
    run(options);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageExit;
  } catch (const Error& error) {
    fmt::print(stderr, "asdf-vk-generate: {}\n", error.what());
    return error.kind() == ErrorKind::Output ? kOutputExit : kUsageExit;
  } catch (const std::exception& error) {
    fmt::print(stderr, "asdf-vk-generate: {}\n", error.what());
    return kUsageExit;
  }
}
