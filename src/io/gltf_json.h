#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

/// The JSON of a glTF file. All functions throw Error{UnreadableInput}; the messages about members begin with `where`,
/// for example "node 3".
namespace asdfvk {

using GltfJson = nlohmann::json;

/// Parses a document in linear time. Zero bytes after its end are ignored. Throws for a syntax error, for more than 64
/// levels of nesting, and for an object with two members of one name.
[[nodiscard]] GltfJson parseGltfJson(std::span<const char> text);

[[noreturn]] void failGltf(std::string_view where, std::string_view reason);

/// Returns null if the object has no such member. Throws if `object` is not a JSON object.
[[nodiscard]] const GltfJson* gltfMember(const GltfJson& object, const char* key, std::string_view where);
/// Returns a non-negative integer, or `fallback` if there is no such member. Throws if both are missing.
[[nodiscard]] uint64_t gltfWhole(const GltfJson& object, const char* key, std::optional<uint64_t> fallback,
                                 std::string_view where);
/// Returns null if there is no such member.
[[nodiscard]] const GltfJson* gltfArray(const GltfJson& object, const char* key, std::string_view where);
/// Returns an empty text if there is no such member.
[[nodiscard]] std::string gltfText(const GltfJson& object, const char* key, std::string_view where);
/// Returns `fallback` if there is no such member.
[[nodiscard]] bool gltfFlag(const GltfJson& object, const char* key, bool fallback, std::string_view where);
/// Reads numbers.size() finite numbers into `numbers`. Returns false if there is no such member.
[[nodiscard]] bool gltfNumbers(const GltfJson& object, const char* key, std::span<double> numbers,
                               std::string_view where);
/// Returns null if `object` does not have this extension.
[[nodiscard]] const GltfJson* gltfExtension(const GltfJson& object, const char* name, std::string_view where);

/// The number of items in an array of the document, for example in "nodes".
[[nodiscard]] uint64_t gltfCount(const GltfJson& document, const char* array);
/// Returns an item of an array of the document. Throws if it does not exist.
[[nodiscard]] const GltfJson& gltfItem(const GltfJson& document, const char* array, uint64_t index,
                                       std::string_view where);
/// Whether the document requires the extension.
[[nodiscard]] bool gltfRequires(const GltfJson& document, std::string_view extension);

}  // namespace asdfvk
