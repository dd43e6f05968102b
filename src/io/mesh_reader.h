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

// One reader per format. Text may have LF, CRLF or CR line ends and a UTF-8 byte order mark. Each throws Error{Input}
// for a file that is cut short, goes on behind its end, names a vertex that it has not, or has no face of three
// corners; none takes more memory than 64 times the input and a few MB. Faces of other than three corners are cut into
// triangles (see triangulate.h) and kept in Mesh::polygons.

/// PLY 1.0, ascii and binary of either byte order. Wanted are element `vertex` with x, y, z of any numeric type, and
/// element `face` with the list vertex_indices or vertex_index, or `tristrips` (see triangle_strip.h), or both; in any
/// order. All else is passed over. In ASCII each row begins on a new line.
[[nodiscard]] Mesh parsePly(std::span<const char> bytes);

/// ASCII OFF with the prefixes ST, C and N, or without the OFF line. Each vertex has a line of its own; what stands
/// behind its coordinates must fit the prefixes. Up to four colour numbers may stand behind a face.
[[nodiscard]] Mesh parseOff(std::span<const char> bytes);

/// OBJ: `v` and `f`; other statements of the format are passed over, except `call`; words that are none are errors.
[[nodiscard]] Mesh parseObj(std::span<const char> bytes);

/// STL, ASCII or binary, which a file is whose size is to the byte what its face count makes. Corners at the same point
/// become one vertex, in order of first appearance (-0 equals 0, NaN equals nothing).
[[nodiscard]] Mesh parseStl(std::span<const char> bytes);

}  // namespace asdfvk
