#include "generate/shapes.h"

#include <fmt/core.h>

#include <array>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "generate/thickness_parts.h"

namespace asdfvk {
namespace {

struct NamedShape {
  std::string_view name;
  GeneratedShape (*make)(uint64_t faceCount);
};

constexpr std::array kShapes{
    NamedShape{"animal", [](uint64_t n) { return makeAnimal(n); }},
    NamedShape{"hand", [](uint64_t n) { return makeHand(n); }},
    NamedShape{"figure", [](uint64_t n) { return makeFigure(n); }},
    NamedShape{"tree", [](uint64_t n) { return makeTree(n); }},
    NamedShape{"sphere", [](uint64_t n) { return makeSphere(n); }},
    NamedShape{"icosphere", [](uint64_t n) { return makeIcosphere(n); }},
    NamedShape{"slab", [](uint64_t n) { return makeSlab(n); }},
    NamedShape{"cylinder", [](uint64_t n) { return makeCylinder(n); }},
    NamedShape{"torus", [](uint64_t n) { return makeTorus(n); }},
    NamedShape{"cube", [](uint64_t n) { return makeCube(n); }},
};

}  // namespace

std::vector<std::string_view> shapeNames() {
  std::vector<std::string_view> names;
  for (const NamedShape& shape : kShapes) names.push_back(shape.name);
  return names;
}

GeneratedShape generateShape(std::string_view name, uint64_t faceCount) {
  if (faceCount < kMinFaceCount || faceCount > kMaxFaceCount)
    throw Error(ErrorCode::OptionOutOfRange,
                fmt::format("a face count of {} is out of range ({} to {})", groupDigits(faceCount), kMinFaceCount,
                            groupDigits(kMaxFaceCount)));
  for (const NamedShape& shape : kShapes)
    if (shape.name == name) return shape.make(faceCount);
  throw Error(ErrorCode::OptionOutOfRange, fmt::format("unknown shape {}; the shapes are {}; the parts are {}", name,
                                                       joined(shapeNames(), ", "), joined(thicknessPartNames(), ", ")));
}

}  // namespace asdfvk
