#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <utility>

#include "asdf_vk/error.h"
#include "generate/corpus_files.h"
#include "generate/generated_shape.h"
#include "generate/generator_options.h"
#include "generate/shapes.h"
#include "generate/thickness_parts.h"

namespace {

using namespace asdfvk;

void place(GeneratedShape& shape, const GeneratorOptions& options) {
  const Vec3d shift{options.translate[0], options.translate[1], options.translate[2]};
  for (Vec3d& p : shape.mesh.vertices) p = p * options.scale + shift;
  for (float& diameter : shape.diameter) diameter = static_cast<float>(diameter * options.scale);
}

/// Makes a part. The diameter of every face is set to the least thickness of the part.
GeneratedShape makePart(const GeneratorOptions& options) {
  const ThicknessPart part = makeThicknessPart(options.shape);
  SurfaceDivision division;
  if (options.longestEdge > 0) division.longestEdge = options.longestEdge;
  fmt::print(stderr, "least thickness {}\n", part.leastThickness * options.scale);
  return withUniformDiameter(part.solid.surface(division), part.leastThickness);
}

GeneratedShape make(const ArgumentParser& parser, const GeneratorOptions& options) {
  const std::vector<std::string_view> parts = thicknessPartNames();
  const bool isPart = std::find(parts.begin(), parts.end(), options.shape) != parts.end();
  if (isPart && parser.isGiven("--faces"))
    throw Error(ErrorCode::OptionConflict, "--faces does not apply to parts; give --longest-edge");
  if (!isPart && parser.isGiven("--longest-edge"))
    throw Error(ErrorCode::OptionConflict, "--longest-edge applies to parts only; give --faces");
  return isPart ? makePart(options) : generateShape(options.shape, options.faceCount);
}

void runCorpus(const ArgumentParser& parser, const GeneratorOptions& options) {
  if (parser.givenNames().size() > 1)
    throw Error(ErrorCode::OptionConflict, "--corpus FOLDER takes no shape and no other option");
  const size_t count = writeCorpus(options.corpus);
  fmt::print(stderr, "{}: {} parts, truth.json\n", options.corpus, count);
}

void run(const ArgumentParser& parser, const GeneratorOptions& options) {
  if (parser.isGiven("--corpus")) return runCorpus(parser, options);
  for (const auto& [name, value] : {std::pair("SHAPE", options.shape), std::pair("--output", options.output)})
    if (value.empty())
      throw Error(ErrorCode::OptionOutOfRange,
                  fmt::format("{} is missing; asdf-vk-generate --help lists the options", name));
  if (!(options.scale > 0) || !std::isfinite(options.scale))
    throw Error(ErrorCode::OptionOutOfRange, "--scale must be a positive number");
  if (parser.isGiven("--longest-edge") && !(options.longestEdge > 0))
    throw Error(ErrorCode::OptionOutOfRange, "--longest-edge must be a positive number");
  GeneratedShape shape = make(parser, options);
  place(shape, options);
  writeGeneratedPly(options.output, shape, options.doubleVertices);
  fmt::print(stderr, "{}: {} with {} faces, {} vertices\n", options.output, options.shape, shape.mesh.faces.size(),
             shape.mesh.vertices.size());
}

}  // namespace

int main(int argc, char** argv) {
  GeneratorOptions options;
  ArgumentParser parser = parserOf(options);
  try {
    if (const std::string answer = parser.parse({argv + 1, argv + argc}); !answer.empty()) {
      std::fputs(answer.c_str(), stdout);
      return 0;
    }
    run(parser, options);
    return 0;
  } catch (const Error& error) {
    fmt::print(stderr, "asdf-vk-generate: {}\n", error.what());
    return error.kind() == ErrorKind::Output ? kGeneratorOutput : kGeneratorUsage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "asdf-vk-generate: {}\n", error.what());
    return kGeneratorUsage;
  }
}
