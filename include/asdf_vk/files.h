#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/field.h"
#include "asdf_vk/mesh.h"

namespace asdfvk {

/// Reads a mesh of PLY, OFF, OBJ, STL, GLB, glTF or 3MF, "-" from standard input. The format is detected from the
/// content, or from the extension where the content is ambiguous (OBJ and binary STL have no magic number). Files that
/// the mesh refers to are not opened. Throws Error{UnreadableInput}: one line with the file, the line or byte, and the
/// reason; Error{MeshTooLarge}, Error{InputTooLarge}.
[[nodiscard]] ASDFVK_API Mesh readMesh(const std::filesystem::path& path);

/// readMesh() from memory. extension: "ply", ".OBJ", or empty; used where the content is ambiguous.
[[nodiscard]] ASDFVK_API Mesh parseMesh(std::span<const char> bytes, std::string_view extension = {});

/// Names of the formats that readMesh() reads.
[[nodiscard]] ASDFVK_API std::vector<std::string> meshFormats();
/// The extensions of their files, in lower case without the dot.
[[nodiscard]] ASDFVK_API std::vector<std::string> meshExtensions();

struct WriteOptions {
  std::string format;  ///< One of resultFormats(); empty: by the extension. Required for "-".
  /// Names of the fields to write, in this order, each with all its locations; empty: all.
  std::vector<std::string> fields = {};
  bool ascii = false;  ///< PLY only; other formats ignore it.
  /// Field of one component whose colours the file shows, in .ply, .glb and .obj; empty: "segment" where it is written,
  /// else the first real field.
  std::string colourOf = {};
  bool coloursVertices = false;  ///< PLY only: colours of the vertices, too. GLB and OBJ have them anyway.
};

/// Names of the formats that writeResult() writes.
[[nodiscard]] ASDFVK_API std::vector<std::string> resultFormats();

/// The format that writeResult() would choose. Throws Error{UnknownFormat} where neither the options nor the extension
/// of the path name one.
[[nodiscard]] ASDFVK_API std::string resultFormatOf(const std::filesystem::path& path,
                                                    const WriteOptions& options = {});

/// Writes the fields, and in .ply, .vtu, .glb and .obj also the mesh. The file is replaced atomically; "-" is standard
/// output. Vertices are float if every coordinate is exactly representable as float, else double. PLY: the first
/// real-valued face field with one component is the property `quality` of the faces and determines their colour; the
/// first such vertex field does so for the vertices. The other fields are properties with their own names. VTU and NPZ
/// have all fields; in NPZ a vertex field with the name of a face field is stored as vertex_NAME. NPY has the first
/// field. GLB has a vertex per corner, with the fields as attributes _NAME; a segment is a primitive with a material of
/// its own. OBJ has colours of the vertices only; segments are materials, in PATH.mtl. CSV has one row per face with
/// the first column `face`, or, if no field is per face, one row per vertex with the first column `vertex`. PLY and CSV
/// split three components into NAME_x, NAME_y and NAME_z. A missing value is NaN in .npy, .npz and .csv, 0 in .ply,
/// .vtu and .glb. Throws Error{OutputNotWritable}; Error{UnknownFormat}; Error{ValueOutOfRange} for real numbers that
/// do not fit into float32 (requireSingles()), but in .csv; Error{UnknownField} for a name that no field has;
/// Error{OptionConflict} for a field whose size does not fit the mesh, an invalid or repeated name, and fields that the
/// format cannot hold; Error{ArraySize}, Error{IndexOutOfRange} for an invalid mesh.
ASDFVK_API void writeResult(const std::filesystem::path& path, const MeshView& mesh, std::span<const Field> fields,
                            const WriteOptions& options = {});

/// Writes the points of the face fields "centre" and "sdf" (Options::computesCentres). A .swc has a tree for each
/// component of the face field "component", or one of all points without it: the minimum spanning tree, with the point
/// of the greatest radius as its root; points of radius 0 are left out. Any other name is a point cloud in binary PLY.
/// A point has `double x y z`, `float radius`, which is half of the shape diameter, and `uint part` where there is the
/// face field "segment". Faces without a value have no point. The file is replaced atomically; "-" is standard output.
/// Throws Error{UnknownField} without these fields; Error{OptionConflict} where their sizes do not fit each other, or
/// "component" has real numbers;
/// Error{ValueOutOfRange}, see requireSingles(); Error{OutputNotWritable}.
ASDFVK_API void writePoints(const std::filesystem::path& path, std::span<const Field> fields);

}  // namespace asdfvk
