#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "asdf_vk/mesh.h"

namespace asdfvk {

/// Whether the content of a file is of a format. Possible is weaker than the extension of the file, Certain is
/// stronger.
enum class Match { None, Possible, Certain };

/// A row of the table in formats.cpp. A function is null where the format lacks the operation.
struct FileFormat {
  std::string_view name;                       ///< Lower case.
  std::array<std::string_view, 4> extensions;  ///< Lower case, without the dot; unused entries are empty.
  Match (*detect)(std::span<const char> bytes);
  Mesh (*parseMesh)(std::span<const char> bytes);
};

[[nodiscard]] std::span<const FileFormat> fileFormats();

/// extension: in any case, with or without the dot. Null for an unknown one.
[[nodiscard]] const FileFormat* formatOfExtension(std::string_view extension);

/// The first format whose content matches with certainty, else that of the extension, else the first possible one, else
/// null.
[[nodiscard]] const FileFormat* detectFormat(std::span<const char> bytes, std::string_view extension);

/// "STL, PLY or OFF": the formats in which meshes are read, for messages.
[[nodiscard]] std::string meshFormatNames();

// Readers of meshes. Text may have LF, CRLF or CR line ends and a UTF-8 byte order mark. Each throws
// Error{UnreadableInput} for a file that is truncated, continues after its end, has an index out of range, or has no
// face with three corners. Memory: at most 64 times the size of the input and a few MB. A file with other faces than
// triangles fills Mesh::polygons, and is triangulated (triangulate.h).

/// ASCII STL, or binary STL, recognised by the exact size that its face count implies. Corners at the same point become
/// one vertex, in order of first appearance (-0 equals 0, NaN equals nothing).
[[nodiscard]] Match detectStl(std::span<const char> bytes);
[[nodiscard]] Mesh parseStl(std::span<const char> bytes);

/// PLY 1.0, ASCII and binary of either byte order. Required: element `vertex` with x, y, z of any numeric type, and
/// element `face` with the list vertex_indices or vertex_index, or `tristrips`, or both; in any order. Ignores all
/// other elements and properties. In ASCII each row begins on a new line.
[[nodiscard]] Match detectPly(std::span<const char> bytes);
[[nodiscard]] Mesh parsePly(std::span<const char> bytes);

/// ASCII OFF with the prefixes ST, C and N, or without the OFF line. One vertex per line; the numbers after its
/// coordinates must agree with the prefixes. Up to four colour numbers may follow a face.
[[nodiscard]] Match detectOff(std::span<const char> bytes);
[[nodiscard]] Mesh parseOff(std::span<const char> bytes);

/// OBJ: `v` and `f`. Ignores all other statements of the format except `call`, which is an error, as is an unknown one.
[[nodiscard]] Match detectObj(std::span<const char> bytes);
[[nodiscard]] Mesh parseObj(std::span<const char> bytes);

}  // namespace asdfvk
