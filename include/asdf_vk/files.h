#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/api.h"
#include "asdf_vk/field.h"
#include "asdf_vk/mesh.h"
#include "asdf_vk/options.h"
#include "asdf_vk/run_control.h"

namespace asdfvk {

struct ReadOptions {
  /// Greatest number of faces of the mesh. 0: 100 per byte of the file, and at least 100,000. Small files can describe
  /// many faces by instances.
  uint64_t maxFaces = 0;
  /// The extension of a format, for example "stl" or ".OBJ". It decides if the content is ambiguous. Empty: the
  /// extension of the path.
  std::string format = {};
  /// Greatest distance between the triangles and the curved surfaces of a STEP file, in `chordErrorUnit`. 0: 1/1000 of
  /// the diagonal of the bounding box. Raised to the resolution, 2^-21 of the longest side of the bounding box. Also,
  /// the angle between consecutive chords of a curve is at most 20 degrees. Other formats ignore it.
  double chordError = 0;
  LengthUnit chordErrorUnit = LengthUnit::OfMesh;
};

/// Reads a mesh file: PLY, OFF, OBJ, STL, GLB, glTF, 3MF or STEP. STEP needs a module (docs/formats.md). path: "-" is
/// standard input. The content decides the format. If the content is ambiguous, the extension decides (OBJ and binary
/// STL have no magic number). A .gltf file may name files with its data that are in its folder; no other files are
/// opened. Throws Error{UnreadableInput}, whose message has the file, the line or byte, and the
/// reason; Error{TooManyFaces} beyond ReadOptions::maxFaces; Error{MeshTooLarge}; Error{InputTooLarge}.
[[nodiscard]] ASDFVK_API Mesh readMesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads a mesh from the bytes of a mesh file, as readMesh() does, but opens no other file.
[[nodiscard]] ASDFVK_API Mesh parseMesh(std::span<const char> bytes, const ReadOptions& options = {});

/// One mesh with the faces of all meshes, in their order; for example the parts of an assembly, or an outer and an
/// inner surface. names: a name per mesh, for the faces before its first object. The meshes share no vertices. Throws
/// Error{UnitsDiffer} if meshes state different units (a mesh without a unit may be in mm), Error{MeshTooLarge} if
/// 32-bit indices do not suffice, and Error{ArraySize}.
[[nodiscard]] ASDFVK_API Mesh joinMeshes(std::span<const Mesh* const> meshes, std::span<const std::string> names);

[[nodiscard]] ASDFVK_API std::vector<std::string> meshFormats();
/// The extensions are in lower case and without the dot.
[[nodiscard]] ASDFVK_API std::vector<std::string> meshExtensions();

struct WriteOptions {
  std::string format;  ///< One of resultFormats(). Empty: the extension decides; not allowed for the path "-".
  /// Names of the fields to write, in this order; empty: all fields. A name selects both the face field and the vertex
  /// field with this name.
  std::vector<std::string> fields = {};
  bool ascii = false;  ///< Writes PLY as text. Other formats ignore this option.
  /// Field of one component that decides the colours in .ply, .glb and .obj. Empty: the field "segment" if it is
  /// written, else the first field of real numbers.
  std::string colourOf = {};
  bool coloursVertices = false;  ///< Colours the vertices in PLY. GLB and OBJ always have vertex colours.
};

[[nodiscard]] ASDFVK_API std::vector<std::string> resultFormats();

/// Throws Error{UnknownFormat} if neither the options nor the extension of the path name a format.
[[nodiscard]] ASDFVK_API std::string resultFormatOf(const std::filesystem::path& path,
                                                    const WriteOptions& options = {});

/// Writes the fields; .ply, .vtu, .glb and .obj files also have the mesh. Replaces the file atomically; "-" is standard
/// output.
/// - PLY: the first real face field with one component is the face property `quality`. The first real vertex field with
/// one component is the vertex property `quality`. All other fields are properties with their own names.
/// - VTU, NPZ: all fields. In NPZ, a vertex field with the name of a face field is stored as vertex_NAME.
/// - NPY: the first field only.
/// - GLB: one vertex per corner of each triangle. Each field is an attribute _NAME of the vertices. Each segment is a
/// primitive with its own material.
/// - OBJ: vertex colours, but no values. Each segment is a material in PATH.mtl.
/// - CSV: a row per face, with the first column `face`. Without a face field: a row per vertex, with the first column
/// `vertex`.
/// In .ply, .vtu and .obj, coordinates are float if float represents all of them exactly, else double. PLY and CSV
/// split a field of three components into NAME_x, NAME_y and NAME_z. A missing value is NaN in .npy, .npz and .csv, and
/// 0 in .ply, .vtu and .glb.
///
/// Throws Error{OutputNotWritable}; Error{UnknownFormat}; Error{ValueOutOfRange} as requireSingles(), except for .csv;
/// Error{UnknownField} for a name that no field has; Error{OptionConflict} for a field whose size does not fit the
/// mesh, an invalid or repeated name, or a field that the format cannot hold; Error{ArraySize} and
/// Error{IndexOutOfRange} for an invalid mesh.
ASDFVK_API void writeResult(const std::filesystem::path& path, const MeshView& mesh, std::span<const Field> fields,
                            const WriteOptions& options = {});

/// Writes the skeleton points of the faces, from the face fields "centre" and "sdf" (Options::computesCentres). The
/// radius of a point is half of the shape diameter. Faces without a value have no point. A .swc file has one minimum
/// spanning tree of points per component (face field "component"). Without this field the file has one tree of all
/// points. The root of a tree is the point with the greatest radius; points of radius 0 are omitted. With any other
/// extension, the file is a point cloud in binary PLY. A point has `double x y z` and `float radius`, and also `uint
/// part` if there is a face field "segment". Replaces the file atomically; "-" is standard output. Throws
/// Error{UnknownField} if "centre" or "sdf" is missing; Error{OptionConflict} if the sizes of the fields do not fit
/// each other or "component" holds real numbers; Error{ValueOutOfRange} as requireSingles(); Error{OutputNotWritable};
/// Error{Cancelled} while a .swc file is made. control: only the cancellation is used.
ASDFVK_API void writePoints(const std::filesystem::path& path, std::span<const Field> fields,
                            const RunControl& control = {});

}  // namespace asdfvk
