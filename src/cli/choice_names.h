#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "cli/command_line.h"

/// The names of what options choose between: as they are read, and as they are reported.
namespace asdfvk {

template <typename T, size_t N>
using ChoiceNames = std::array<std::pair<const char*, T>, N>;

inline constexpr ChoiceNames<Recipe, 3> kRecipes{
    {{"paper", Recipe::Paper}, {"balanced", Recipe::Balanced}, {"quality", Recipe::Quality}}};

inline constexpr ChoiceNames<ConeRotation, 2> kConeRotations{
    {{"fixed", ConeRotation::Fixed}, {"hashed", ConeRotation::Hashed}}};

inline constexpr ChoiceNames<ArcWeightKind, 2> kWeights{
    {{"distance", ArcWeightKind::Distance}, {"feature", ArcWeightKind::Feature}}};

inline constexpr ChoiceNames<Guidance, 3> kGuidances{
    {{"none", Guidance::None}, {"curvature", Guidance::Curvature}, {"hits", Guidance::Hits}}};

inline constexpr ChoiceNames<SolverChoice, 5> kSolvers{{{"auto", SolverChoice::Auto},
                                                        {"cg", SolverChoice::Cg},
                                                        {"jacobi", SolverChoice::Jacobi},
                                                        {"cpu", SolverChoice::Cpu},
                                                        {"eigen", SolverChoice::Eigen}}};

inline constexpr ChoiceNames<Orientation, 3> kOrientations{
    {{"keep", Orientation::Keep}, {"auto", Orientation::Auto}, {"flip", Orientation::Flip}}};

inline constexpr ChoiceNames<Backend, 4> kBackends{
    {{"auto", Backend::Auto}, {"vulkan", Backend::Vulkan}, {"cpu", Backend::Cpu}, {"reference", Backend::Reference}}};

/// auto: as it is best on the device.
inline constexpr ChoiceNames<std::optional<TraceKernel>, 4> kTraceKernels{
    {{"auto", std::nullopt}, {"seed", TraceKernel::Seed}, {"ray", TraceKernel::Ray}, {"packet", TraceKernel::Packet}}};

inline constexpr ChoiceNames<std::optional<BvhLayout>, 3> kBvhLayouts{
    {{"auto", std::nullopt}, {"wide", BvhLayout::Wide}, {"binary", BvhLayout::Binary}}};

inline constexpr ChoiceNames<std::optional<BvhFetch>, 3> kBvhFetches{
    {{"auto", std::nullopt}, {"texel", BvhFetch::Texel}, {"storage", BvhFetch::Storage}}};

inline constexpr ChoiceNames<PictureOf, 3> kPictures{
    {{"sdf", PictureOf::Sdf}, {"seeds", PictureOf::Seeds}, {"error", PictureOf::Error}}};

/// "paper|balanced|quality"
template <typename T, size_t N>
[[nodiscard]] std::string joined(const ChoiceNames<T, N>& names) {
  std::string text;
  for (const auto& [name, value] : names) text += (text.empty() ? "" : "|") + std::string(name);
  return text;
}

template <typename T, size_t N>
[[nodiscard]] const char* nameOf(const ChoiceNames<T, N>& names, const T& value) {
  for (const auto& [name, candidate] : names)
    if (candidate == value) return name;
  return "";
}

/// "seed wide texel"
[[nodiscard]] inline std::string nameOf(const VulkanTraceChoice& choice) {
  return std::string(nameOf(kTraceKernels, {choice.kernel})) + " " + nameOf(kBvhLayouts, {choice.bvh}) + " " +
         nameOf(kBvhFetches, {choice.fetch});
}

}  // namespace asdfvk
