#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "mesh/mesh.h"

namespace asdfvk {

enum class MeshFormat { Ply, Off, Obj, Stl };

/// Reads the whole mesh or throws Error{Input} whose one line names the file, the line or byte, and the reason.
/// "-" reads standard input. The format is told by the content, then by the extension (OBJ and binary STL have no magic
/// number). No other file is ever opened.
[[nodiscard]] Mesh readMesh(const std::filesystem::path& path);

/// The same from memory. `extension` ("ply", ".OBJ", may be empty) helps where the content does not tell.
[[nodiscard]] Mesh parseMesh(std::span<const char> bytes, std::string_view extension);

[[nodiscard]] Mesh parsePly(std::span<const char> bytes);
[[nodiscard]] Mesh parseOff(std::span<const char> bytes);
[[nodiscard]] Mesh parseObj(std::span<const char> bytes);
[[nodiscard]] Mesh parseStl(std::span<const char> bytes);

}  // namespace asdfvk
