#include "cli/settings_json.h"

#include <type_traits>
#include <utility>

#include "core/json.h"

namespace asdfvk {
namespace {

/// Calls visit(member) for every member of `object`, which is `Struct` or const Struct.
template <typename Struct, typename Object, typename Visit>
void visitMembers(Object& object, const Visit& visit) {
  const auto visitAll = [&](auto&... members) { (visit(members), ...); };
  if constexpr (std::is_same_v<Struct, MeshSettings>) {
    auto& [session, computation, compared, outputs, timeoutSeconds, makesFolders, isOfBatch] = object;
    visitAll(session, computation, compared, outputs, timeoutSeconds, makesFolders, isOfBatch);
  } else if constexpr (std::is_same_v<Struct, SessionOptions>) {
    auto& [backend, device, requireGpu, variant] = object;
    visitAll(backend, device, requireGpu, variant);
  } else if constexpr (std::is_same_v<Struct, TraceVariant>) {
    auto& [kernel, bvh, fetch] = object;
    visitAll(kernel, bvh, fetch);
  } else if constexpr (std::is_same_v<Struct, Computation>) {
    auto& [recipe, options, failIfThinner, valueOptions, against] = object;
    visitAll(recipe, options, failIfThinner, valueOptions, against);
  } else if constexpr (std::is_same_v<Struct, Outputs>) {
    auto& [path, format, fields, ascii, picture, pictureOf, pictureView, choosesView, points, opensPage, json, quiet,
           verbose] = object;
    visitAll(path, format, fields, ascii, picture, pictureOf, pictureView, choosesView, points, opensPage, json, quiet,
             verbose);
  } else if constexpr (std::is_same_v<Struct, View>) {
    auto& [up, azimuthDegrees, elevationDegrees] = object;
    visitAll(up, azimuthDegrees, elevationDegrees);
  } else if constexpr (std::is_same_v<Struct, Options>) {
    auto& [cone, seeds, sampler, randomSeed, interpolation, smoothing, postprocess, segmentation, cgalSegmentation,
           parts, measure, thickness, estimatesError, rounds, solver, solverOptions, orientation, computesCentres, per,
           checkCount, keepsScene] = object;
    visitAll(cone, seeds, sampler, randomSeed, interpolation, smoothing, postprocess, segmentation, cgalSegmentation,
             parts, measure, thickness, estimatesError, rounds, solver, solverOptions, orientation, computesCentres,
             per, checkCount, keepsScene);
  } else if constexpr (std::is_same_v<Struct, ConeOptions>) {
    auto& [rayCount, angle, falseHitAngle, outlierDeviations, rotation, definition] = object;
    visitAll(rayCount, angle, falseHitAngle, outlierDeviations, rotation, definition);
  } else if constexpr (std::is_same_v<Struct, SeedCount> || std::is_same_v<Struct, InterpolationOptions> ||
                       std::is_same_v<Struct, CgalSegmentationOptions> || std::is_same_v<Struct, ThicknessOptions> ||
                       std::is_same_v<Struct, RoundOptions>) {
    auto& [first, second, third] = object;
    visitAll(first, second, third);
  } else {
    auto& [first, second] = object;
    visitAll(first, second);
  }
}

template <typename T>
struct ElementOf : std::false_type {};
template <typename T>
struct ElementOf<std::optional<T>> : std::true_type {
  using Type = T;
};

template <typename T>
constexpr bool kIsValue =
    std::is_arithmetic_v<T> || std::is_same_v<T, std::string> || std::is_same_v<T, std::vector<std::string>>;

template <typename T>
Json valueOf(const T& value) {
  if constexpr (kIsValue<T>) {
    return value;
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<int>(value);
  } else if constexpr (ElementOf<T>::value) {
    return value ? Json::array({valueOf(*value)}) : Json();
  } else {
    Json json = Json::array();
    visitMembers<T>(value, [&](const auto& member) { json.push_back(valueOf(member)); });
    return json;
  }
}

template <typename T>
void read(const Json& json, T& value) {
  if constexpr (kIsValue<T>) {
    json.get_to(value);
  } else if constexpr (std::is_enum_v<T>) {
    value = static_cast<T>(json.get<int>());
  } else if constexpr (ElementOf<T>::value) {
    if (json.is_null()) return;
    typename ElementOf<T>::Type element;
    read(json.at(0), element);
    value = std::move(element);
  } else {
    size_t i = 0;
    visitMembers<T>(value, [&](auto& member) { read(json.at(i++), member); });
  }
}

}  // namespace

Json toJson(const MeshSettings& settings) { return valueOf(settings); }

MeshSettings settingsOf(const Json& json) {
  MeshSettings settings;
  read(json, settings);
  return settings;
}

}  // namespace asdfvk
