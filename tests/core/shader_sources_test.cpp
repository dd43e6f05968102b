// Rules for the GLSL sources of the repository, tested on their text.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

using Strings = std::vector<std::string>;

/// The functions of GLSL 4.60, chapter 8, with those of the compatibility profile and of subgroups. The variables of
/// GLSL begin with gl_; the compiler refuses other variables with such names.
constexpr const char* kBuiltinFunctions = R"(
  radians degrees sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh pow exp log exp2 log2 sqrt inversesqrt
  abs sign floor trunc round roundEven ceil fract mod modf min max clamp mix step smoothstep isnan isinf floatBitsToInt
  floatBitsToUint intBitsToFloat uintBitsToFloat fma frexp ldexp
  packUnorm2x16 packSnorm2x16 packUnorm4x8 packSnorm4x8 unpackUnorm2x16 unpackSnorm2x16 unpackUnorm4x8 unpackSnorm4x8
  packHalf2x16 unpackHalf2x16 packDouble2x32 unpackDouble2x32
  length distance dot cross normalize ftransform faceforward reflect refract
  matrixCompMult outerProduct transpose determinant inverse
  lessThan lessThanEqual greaterThan greaterThanEqual equal notEqual any all not
  uaddCarry usubBorrow umulExtended imulExtended bitfieldExtract bitfieldInsert bitfieldReverse bitCount findLSB findMSB
  textureSize textureQueryLod textureQueryLevels textureSamples texture textureProj textureLod textureOffset texelFetch
  texelFetchOffset textureProjOffset textureLodOffset textureProjLod textureProjLodOffset textureGrad textureGradOffset
  textureProjGrad textureProjGradOffset textureGather textureGatherOffset textureGatherOffsets
  texture1D texture1DProj texture1DLod texture1DProjLod texture2D texture2DProj texture2DLod texture2DProjLod texture3D
  texture3DProj texture3DLod texture3DProjLod textureCube textureCubeLod shadow1D shadow2D shadow1DProj shadow2DProj
  shadow1DLod shadow2DLod shadow1DProjLod shadow2DProjLod
  atomicCounterIncrement atomicCounterDecrement atomicCounter atomicCounterAdd atomicCounterSubtract atomicCounterMin
  atomicCounterMax atomicCounterAnd atomicCounterOr atomicCounterXor atomicCounterExchange atomicCounterCompSwap
  atomicAdd atomicMin atomicMax atomicAnd atomicOr atomicXor atomicExchange atomicCompSwap
  imageSize imageSamples imageLoad imageStore imageAtomicAdd imageAtomicMin imageAtomicMax imageAtomicAnd imageAtomicOr
  imageAtomicXor imageAtomicExchange imageAtomicCompSwap
  EmitStreamVertex EndStreamPrimitive EmitVertex EndPrimitive dFdx dFdy dFdxFine dFdyFine dFdxCoarse dFdyCoarse fwidth
  fwidthFine fwidthCoarse interpolateAtCentroid interpolateAtSample interpolateAtOffset noise1 noise2 noise3 noise4
  barrier memoryBarrier memoryBarrierAtomicCounter memoryBarrierBuffer memoryBarrierShared memoryBarrierImage
  groupMemoryBarrier subpassLoad anyInvocation allInvocations allInvocationsEqual
  subgroupBarrier subgroupMemoryBarrier subgroupElect subgroupAll subgroupAny subgroupAllEqual subgroupBroadcast
  subgroupBroadcastFirst subgroupBallot subgroupAdd subgroupMul subgroupMin subgroupMax subgroupAnd subgroupOr
  subgroupXor subgroupShuffle subgroupShuffleXor)";

const std::set<std::string>& builtinFunctions() {
  static const std::set<std::string> names = [] {
    std::istringstream words(kBuiltinFunctions);
    return std::set<std::string>(std::istream_iterator<std::string>(words), {});
  }();
  return names;
}

/// Words, numbers and single characters, without comments and spaces.
Strings tokensOf(const std::string& source) {
  Strings tokens;
  const auto isWordPart = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (size_t i = 0; i < source.size();) {
    size_t end = i + 1;
    if (source.compare(i, 2, "//") == 0) {
      i = std::min(source.find('\n', i), source.size());
      continue;
    }
    if (isWordPart(source[i]))
      while (end < source.size() && isWordPart(source[end])) ++end;
    if (!std::isspace(static_cast<unsigned char>(source[i]))) tokens.push_back(source.substr(i, end - i));
    i = end;
  }
  return tokens;
}

/// Variables, parameters and functions with the name of a builtin function. A member of a struct hides nothing.
Strings hiddenBuiltins(const std::string& source) {
  const Strings tokens = tokensOf(source);
  Strings hidden;
  for (size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i] == "struct")
      while (i < tokens.size() && tokens[i] != "}") ++i;
    if (i >= tokens.size() || !builtinFunctions().count(tokens[i])) continue;
    const std::string before = i == 0 ? "" : tokens[i - 1], after = i + 1 == tokens.size() ? "" : tokens[i + 1];
    const bool isCall = after == "(" && (before == "return" || before == "else" ||
                                         !std::isalpha(static_cast<unsigned char>(before.empty() ? ' ' : before[0])));
    if (before != "." && !isCall) hidden.push_back(tokens[i]);
  }
  return hidden;
}

struct Source {
  fs::path path;
  std::string text;
};

std::vector<Source> shaderSources() {
  std::vector<Source> sources;
  for (const char* folder : {"bench", "docs", "shaders", "src", "tests"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(ASDFVK_SOURCE_DIR) / folder)) {
      const std::string extension = entry.path().extension().string();
      const bool isShared = extension == ".h" && entry.path().parent_path().filename() == "shared";
      if (extension != ".comp" && extension != ".glsl" && !isShared) continue;
      std::ifstream in(entry.path());
      sources.push_back({entry.path(), {std::istreambuf_iterator<char>(in), {}}});
    }
  return sources;
}

/// The specialization constants of a shader whose id does not have their name, and numbers instead of ids.
Strings badSpecializationIds(const std::string& source) {
  static const std::regex constant(R"((constant_id|local_size_x_id) = (\w+)\) (?:const \w+ (\w+)|in;))");
  Strings bad;
  for (std::sregex_iterator match(source.begin(), source.end(), constant), end; match != end; ++match) {
    const std::string name = (*match)[1] == "constant_id" ? (*match)[3].str() : "kLocalSizeX";
    if ((*match)[2] != name + "Id") bad.push_back(match->str());
  }
  return bad;
}

}  // namespace

TEST_CASE("no variable, parameter or function of a shader has the name of a builtin function of GLSL") {
  const std::vector<Source> sources = shaderSources();
  REQUIRE(sources.size() > 30);
  for (const Source& source : sources)
    for (const std::string& name : hiddenBuiltins(source.text)) FAIL_CHECK(source.path.string(), ": ", name);
}

TEST_CASE("names that hide a builtin function are found") {
  CHECK(hiddenBuiltins("const float length = 1.0;") == Strings{"length"});
  CHECK(hiddenBuiltins("void f(float distance, uint i) {}") == Strings{"distance"});
  CHECK(hiddenBuiltins("float a = 1.0, step = 2.0;") == Strings{"step"});
  CHECK(hiddenBuiltins("float mix(float a) { return a; }") == Strings{"mix"});
  CHECK(hiddenBuiltins("readonly buffer A { float sign[]; };") == Strings{"sign"});
  CHECK(hiddenBuiltins("struct Hit { float distance; }; float a = hit.distance; // length = 1").empty());
  CHECK(hiddenBuiltins("if (a) return length(b); else barrier(); const float c = -dot(a, b) * (max(a, b));").empty());
}

TEST_CASE("each specialization constant has the id of its name") {
  std::ptrdiff_t count = 0;
  for (const Source& source : shaderSources()) {
    for (const std::string& declaration : badSpecializationIds(source.text))
      FAIL_CHECK(source.path.string(), ": ", declaration);
    const Strings tokens = tokensOf(source.text);
    count += std::count(tokens.begin(), tokens.end(), "constant_id");
  }
  CHECK(count > 10);
}

TEST_CASE("numbers and other names as ids of specialization constants are found") {
  CHECK(badSpecializationIds("layout(constant_id = 3) const uint kRayCount = 30;").size() == 1);
  CHECK(badSpecializationIds("layout(constant_id = kIsCgalId) const uint kRayCount = 30;").size() == 1);
  CHECK(badSpecializationIds("layout(local_size_x_id = 6) in;").size() == 1);
  CHECK(badSpecializationIds("layout(local_size_x_id = kLocalSizeXId) in;").empty());
  CHECK(badSpecializationIds("layout(constant_id = kRayCountId) const uint kRayCount = 30;").empty());
}

TEST_CASE("the ids of specialization constants are distinct") {
  std::ifstream in(fs::path(ASDFVK_SOURCE_DIR) / "shaders" / "shared" / "specialization_ids.h");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  static const std::regex id(R"(const uint k\w+Id = (\d+)u;)");
  Strings numbers;
  for (std::sregex_iterator match(text.begin(), text.end(), id), end; match != end; ++match)
    numbers.push_back((*match)[1]);
  CHECK(numbers.size() > 10);
  CHECK(std::set<std::string>(numbers.begin(), numbers.end()).size() == numbers.size());
}
