#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "asdf_vk/options.h"
#include "asdf_vk/session.h"

/// Names of the enumerators of Options and SessionOptions. The command line, the JSON report and the Python module use
/// these names.
namespace asdfvk {

template <typename T, size_t N>
using ChoiceNames = std::array<std::pair<const char*, T>, N>;

inline constexpr ChoiceNames<Recipe, 3> kRecipes{
    {{"paper", Recipe::Paper}, {"balanced", Recipe::Balanced}, {"quality", Recipe::Quality}}};

inline constexpr ChoiceNames<Definition, 2> kDefinitions{{{"paper", Definition::Paper}, {"cgal", Definition::Cgal}}};

inline constexpr ChoiceNames<ConeRotation, 2> kConeRotations{
    {{"fixed", ConeRotation::Fixed}, {"hashed", ConeRotation::Hashed}}};

inline constexpr ChoiceNames<SamplerChoice, 5> kSamplerNames{{{"random", SamplerChoice::Random},
                                                              {"blue-noise", SamplerChoice::BlueNoise},
                                                              {"farthest-point", SamplerChoice::FarthestPoint},
                                                              {"normal-space", SamplerChoice::NormalSpace},
                                                              {"adaptive", SamplerChoice::Adaptive}}};

inline constexpr ChoiceNames<SolverChoice, 5> kSolverNames{{{"auto", SolverChoice::Automatic},
                                                            {"cg", SolverChoice::Cg},
                                                            {"jacobi", SolverChoice::Jacobi},
                                                            {"cpu", SolverChoice::Cpu},
                                                            {"eigen", SolverChoice::Eigen}}};

inline constexpr ChoiceNames<BackendChoice, 4> kBackendNames{{{"auto", BackendChoice::Automatic},
                                                              {"vulkan", BackendChoice::Vulkan},
                                                              {"cpu", BackendChoice::Cpu},
                                                              {"reference", BackendChoice::Reference}}};

inline constexpr ChoiceNames<TraceKernel, 3> kKernels{
    {{"seed", TraceKernel::Seed}, {"ray", TraceKernel::Ray}, {"packet", TraceKernel::Packet}}};

inline constexpr ChoiceNames<BvhFetch, 2> kFetches{{{"texel", BvhFetch::Texel}, {"storage", BvhFetch::Storage}}};

inline constexpr ChoiceNames<ArcWeights, 2> kWeights{
    {{"distance", ArcWeights::Distance}, {"feature", ArcWeights::Feature}}};

inline constexpr ChoiceNames<Guidance, 3> kGuidances{
    {{"none", Guidance::None}, {"curvature", Guidance::Curvature}, {"prediction", Guidance::Prediction}}};

inline constexpr ChoiceNames<Orientation, 3> kOrientations{
    {{"keep", Orientation::Keep}, {"auto", Orientation::Auto}, {"flip", Orientation::Flip}}};

inline constexpr ChoiceNames<Postprocess, 2> kPostprocesses{{{"none", Postprocess::None}, {"cgal", Postprocess::Cgal}}};

inline constexpr ChoiceNames<Segmentation, 3> kSegmentations{
    {{"none", Segmentation::None}, {"parts", Segmentation::Parts}, {"cgal", Segmentation::Cgal}}};

inline constexpr ChoiceNames<Measure, 7> kMeasures{{{"sdf", Measure::ShapeDiameter},
                                                    {"thickness", Measure::Thickness},
                                                    {"both", Measure::Both},
                                                    {"gap", Measure::Gap},
                                                    {"sdf,gap", Measure::DiameterAndGap},
                                                    {"thickness,gap", Measure::ThicknessAndGap},
                                                    {"sdf,thickness,gap", Measure::All}}};

inline constexpr ChoiceNames<CgalExpansion, 2> kCgalExpansions{
    {{"all", CgalExpansion::All}, {"first", CgalExpansion::First}}};

inline constexpr ChoiceNames<PerElement, 2> kPerElements{
    {{"face", PerElement::Faces}, {"vertex", PerElement::Vertices}}};

/// The names with bars between them, for example "paper|balanced|quality".
template <typename T, size_t N>
[[nodiscard]] std::string joined(const ChoiceNames<T, N>& names) {
  std::string text;
  for (const auto& [name, value] : names) text += (text.empty() ? "" : "|") + std::string(name);
  return text;
}

/// Returns the enumerator with the name, or null for an unknown name.
template <typename T, size_t N>
[[nodiscard]] const T* findChoice(const ChoiceNames<T, N>& names, std::string_view name) {
  for (const auto& [candidate, value] : names)
    if (candidate == name) return &value;
  return nullptr;
}

template <typename T, size_t N>
[[nodiscard]] const char* nameOf(const ChoiceNames<T, N>& names, const std::type_identity_t<T>& value) {
  for (const auto& [name, candidate] : names)
    if (candidate == value) return name;
  return "";
}

}  // namespace asdfvk
