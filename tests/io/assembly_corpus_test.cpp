#include <doctest/doctest.h>

#include <filesystem>
#include <map>

#include "core/text.h"
#include "core/vec3.h"
#include "reading.h"
#include "written_file.h"

using namespace asdfvk;
using asdfvk::test::holds;

namespace {

/// A mesh of these counts with this unit, signed volume and rest, or an error that contains `reason`.
struct AssemblyExpectation {
  size_t vertexCount = 0;
  size_t faceCount = 0;
  std::string_view unit;
  double volume = 0;
  std::string_view skipped;
  std::string_view reason;
};

constexpr double kVolume = 1 / 6.0;  // The volume of the tetrahedron that most files have.

AssemblyExpectation part(size_t vertexCount, size_t faceCount, std::string_view unit, double volume,
                         std::string_view skipped = {}) {
  return {vertexCount, faceCount, unit, volume, skipped, {}};
}
AssemblyExpectation refusal(std::string_view reason) { return {.reason = reason}; }

/// write_assembly_corpus.py writes the files.
const std::map<std::string, AssemblyExpectation> kAssemblyExpectations = {
    {"3mf_beam_lattice.3mf", part(4, 4, "mm", kVolume, "1 beam lattice")},
    {"3mf_byte_order_mark.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_component_bomb.3mf",
     refusal("has at least 1,125,899,906,842,624 faces; the limit for a file of 1,442 bytes is 144,200")},
    {"3mf_component_cycle.3mf",
     refusal("object 1 of 3D/3dmodel.model is nested more than 64 levels deep, or in itself")},
    {"3mf_components.3mf", part(8, 8, "mm", 2 * kVolume)},
    {"3mf_components_deep_from_below.3mf", refusal("is nested more than 64 levels deep, or in itself")},
    {"3mf_components_deep.3mf",
     refusal("object 35 of 3D/3dmodel.model is nested more than 64 levels deep, or in itself")},
    {"3mf_coordinate_nan.3mf", refusal("3D/3dmodel.model, byte 189: x 'nan' is not a number")},
    {"3mf_coordinate_plus.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_coordinate_word.3mf", refusal("3D/3dmodel.model, byte 189: x '1.0abc' is not a number")},
    {"3mf_cut_in_half.3mf", refusal("ZIP archive is truncated: it has no directory at its end")},
    {"3mf_damaged_data.3mf", refusal("ZIP archive: '3D/3dmodel.model' is damaged")},
    {"3mf_default_unit.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_deflate_bomb.3mf", refusal("3D/3dmodel.model, byte 3200447: v3 9 is out of range; the mesh has 4 vertices")},
    {"3mf_directory_count.3mf", refusal("ZIP archive: its directory is too small for 60,000 files")},
    {"3mf_directory_offset.3mf", refusal("ZIP archive is damaged: a number points beyond its end")},
    {"3mf_document_type.3mf", refusal("3D/3dmodel.model, byte 16: a document type is not allowed")},
    {"3mf_empty_component_bomb.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_encrypted.3mf",
     refusal("ZIP archive: '_rels/.rels' is encrypted, or compressed by a method other than deflate")},
    {"3mf_four_bytes.3mf", refusal("ZIP archive is truncated: it has no directory at its end")},
    {"3mf_inch.3mf", part(4, 4, "in", kVolume)},
    {"3mf_index_negative.3mf", refusal("3D/3dmodel.model, byte 319: v3 '-1' is not a whole number")},
    {"3mf_index_out_of_range.3mf",
     refusal("3D/3dmodel.model, byte 319: v3 4 is out of range; the mesh has 4 vertices")},
    {"3mf_long_tag.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_metadata.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_method_bzip2.3mf",
     refusal("ZIP archive: '_rels/.rels' is encrypted, or compressed by a method other than deflate")},
    {"3mf_mirrored.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_missing_component.3mf", refusal("there is no object 9 of 3D/3dmodel.model")},
    {"3mf_missing_object.3mf", refusal("there is no object 5 of 3D/3dmodel.model")},
    {"3mf_no_items.3mf", refusal("builds nothing: it has no build item")},
    {"3mf_no_model.3mf", refusal("the archive has no '3D/3dmodel.model'")},
    {"3mf_no_model_relationship.3mf", refusal("is a ZIP archive but not 3MF: _rels/.rels names no model")},
    {"3mf_no_relationships.3mf", refusal("is a ZIP archive but not 3MF: it has no _rels/.rels")},
    {"3mf_object_twice.3mf", refusal("3D/3dmodel.model, byte 783: object 1 occurs twice")},
    {"3mf_other_namespace.3mf",
     refusal("3D/3dmodel.model, byte 39: is not a model of 3MF: it has the namespace 'http://example.com/core'")},
    {"3mf_other_root.3mf", refusal("3D/3dmodel.model, byte 39: expected a model of 3MF, found 'scene'")},
    {"3mf_prefix_of_another.3mf", refusal("has 1 unknown element ('item') and no triangle: nothing to compute on")},
    {"3mf_prefixed.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_prefixed_twice.3mf", part(4, 4, "in", kVolume)},
    {"3mf_production.3mf", part(4, 4, "mm", 1000 * kVolume)},
    {"3mf_production_missing.3mf", refusal("the archive has no '3D/Objects/a.model'")},
    {"3mf_requires_lattice.3mf",
     refusal("3D/3dmodel.model, byte 39: requires the extension 'b' 'http://schemas.microsoft.com/3dmanufacturing/")},
    {"3mf_requires_material.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_split_vertices.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_stored.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_support_only.3mf", refusal("has 1 support and no triangle: nothing to compute on")},
    {"3mf_support_too.3mf", part(4, 4, "mm", kVolume, "1 support")},
    {"3mf_tetrahedron.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_transform_of_11.3mf", refusal("3D/3dmodel.model, byte 507: a transform has 11 numbers instead of 12")},
    {"3mf_transform_of_13.3mf", refusal("3D/3dmodel.model, byte 507: a transform has more than 12 numbers")},
    {"3mf_truncated.3mf", refusal("ZIP archive is truncated: it has no directory at its end")},
    {"3mf_two_items.3mf", part(8, 8, "mm", 9 * kVolume)},
    {"3mf_unknown_unit.3mf", refusal("3D/3dmodel.model, byte 39: 'furlong' is not a unit of 3MF")},
    {"3mf_utf16.3mf", part(4, 4, "mm", kVolume)},
    {"3mf_vertex_without_z.3mf", refusal("3D/3dmodel.model, byte 270: 'vertex' has no z")},
    {"3mf_without_extension", part(4, 4, "mm", kVolume)},
    {"3mf_wrong_checksum.3mf", refusal("ZIP archive: '3D/3dmodel.model' is damaged: its size or checksum differs")},
    {"3mf_xml_after_end.3mf", refusal("3D/3dmodel.model, byte 543: junk after document element")},
    {"3mf_xml_attribute_open.3mf", refusal("3D/3dmodel.model, byte 526: not well-formed (invalid token)")},
    {"3mf_xml_attribute_twice.3mf", refusal("3D/3dmodel.model, byte 526: duplicate attribute")},
    {"3mf_xml_deep.3mf", refusal("3D/3dmodel.model, byte 336: nested more than 64 levels deep")},
    {"3mf_xml_empty.3mf", refusal("3D/3dmodel.model, byte 0: no element found")},
    {"3mf_xml_truncated.3mf", refusal("3D/3dmodel.model, byte 507: truncated: an element has no end")},
    {"3mf_xml_wrong_end.3mf", refusal("3D/3dmodel.model, byte 529: mismatched tag")},
    {"3mf_zip64.3mf", part(4, 4, "mm", kVolume)},
    {"glb_asset_version_1.glb", refusal("glTF version '1.0'; version 2.0 is read: convert the file")},
    {"glb_buffer_longer_than_chunk.glb", refusal("buffer 0: byteLength 1000; its data has 72 bytes")},
    {"glb_chunk_too_long.glb", refusal("byte 20: a chunk of 2147483647 bytes does not fit; 540 are left")},
    {"glb_count_negative.glb", refusal("accessor 0: count is not a non-negative integer")},
    {"glb_count_zero.glb", refusal("has 1 primitive without vertices and no triangle: nothing to compute on")},
    {"glb_draco.glb", refusal("mesh 0, primitive 0 is compressed by Draco, ")},
    {"glb_eleven_indices.glb", refusal("mesh 0, primitive 0: 11 corners do not make triangles")},
    {"glb_fan.glb", part(4, 2, "m", 0)},
    {"glb_float_indices.glb", refusal("accessor 0: componentType 5126 is not allowed here")},
    {"glb_four_bytes.glb", refusal("binary glTF is truncated in its header")},
    {"glb_further_scene.glb", part(4, 4, "m", kVolume, "1 further scene")},
    {"glb_gpu_instances.glb",
     refusal("node 0 has instances by EXT_mesh_gpu_instancing, which is not supported; export without it")},
    {"glb_header_only.glb", refusal("binary glTF is truncated in its header")},
    {"glb_huge_count.glb",
     refusal("accessor 1: 4,000,000,000 elements do not fit into the 48 bytes of its buffer view")},
    {"glb_huge_offset.glb", refusal("accessor 1: 4 elements do not fit into the 48 bytes of its buffer view")},
    {"glb_index_out_of_range.glb",
     refusal("mesh 0, primitive 0: index 4 is out of range; the primitive has 4 vertices")},
    {"glb_indices_as_bytes.glb", part(4, 4, "m", kVolume)},
    {"glb_indices_as_words.glb", part(4, 4, "m", kVolume)},
    {"glb_instance_bomb.glb", refusal("has 128,000,000 faces; the limit for a file of 69,856 bytes is 6,985,600")},
    {"glb_instances.glb", part(8, 8, "m", 9 * kVolume)},
    {"glb_json_array.glb", refusal("glTF: is not a JSON object")},
    {"glb_json_damaged.glb", refusal("byte 29 of the JSON: syntax error")},
    {"glb_json_deep.glb", refusal("JSON nested more than 64 levels deep")},
    {"glb_lines_only.glb", refusal("has 6 lines and no triangle: nothing to compute on")},
    {"glb_material_extension.glb", part(4, 4, "m", kVolume)},
    {"glb_matrix.glb", part(4, 4, "m", 8 * kVolume)},
    {"glb_mesh_not_in_scene.glb", refusal("has no mesh in its scene and no triangle: nothing to compute on")},
    {"glb_mesh_out_of_range.glb", refusal("node 0: entry 7 of meshes is out of range; there are 1")},
    {"glb_meshopt.glb", refusal("buffer view 1 is compressed by meshopt, ")},
    {"glb_mirrored.glb", part(4, 4, "m", kVolume)},
    {"glb_mode_7.glb", refusal("mesh 0, primitive 0: mode 7 is unknown")},
    {"glb_node_cycle.glb", refusal("node 0 has two parents; nodes must form trees")},
    {"glb_node_out_of_range.glb", refusal("scene: entry 7 of nodes is out of range; there are 1")},
    {"glb_node_with_two_parents.glb", refusal("node 1 has two parents; nodes must form trees")},
    {"glb_nodes_no_array.glb", refusal("glTF: nodes is not an array")},
    {"glb_other_file.glb", refusal("buffer 0: its data is in the file '../../etc/passwd', which is not a relative name "
                                   "in the folder of this file")},
    {"glb_points_only.glb", refusal("has 12 points and no triangle: nothing to compute on")},
    {"glb_points_too.glb", part(4, 4, "m", kVolume, "4 points")},
    {"glb_position_of_two.glb", refusal("accessor 1: has the type 'VEC2' instead of VEC3")},
    {"glb_projective_matrix.glb", refusal("node 0: the last row of its matrix is not 0 0 0 1")},
    {"glb_quantised.glb", part(4, 4, "m", kVolume)},
    {"glb_rotation_zero.glb", refusal("node 0: its rotation is not a valid quaternion")},
    {"glb_scene_out_of_range.glb", refusal("glTF: entry 3 of scenes is out of range; there are 1")},
    {"glb_short_translation.glb", refusal("node 0: translation has 2 numbers instead of 3")},
    {"glb_skin.glb", part(4, 4, "m", kVolume, "1 pose of a skin")},
    {"glb_sparse.glb", part(4, 4, "m", 2 * kVolume)},
    {"glb_sparse_without_view.glb", part(2, 4, "m", 0)},
    {"glb_sparse_without_view_huge.glb", part(2, 4, "m", 0)},
    {"glb_sparse_huge.glb", refusal("accessor 1: its sparse part is incomplete")},
    {"glb_split_vertices.glb", part(4, 4, "m", kVolume)},
    {"glb_strip.glb", part(4, 2, "m", -kVolume)},
    {"glb_strip_with_restart.glb", part(4, 2, "m", 0)},
    {"glb_tetrahedron.glb", part(4, 4, "m", kVolume)},
    {"glb_trailing_bytes.glb", part(4, 4, "m", kVolume, "7 bytes after the end")},
    {"glb_transform_overflow.glb", refusal("node 1: its transform overflows")},
    {"glb_truncated.glb", refusal("binary glTF has 560 bytes by its header; this file has 555 and is truncated")},
    {"glb_unknown_chunk.glb", part(4, 4, "m", kVolume)},
    {"glb_unknown_extension.glb",
     refusal("requires the extension 'VENDOR_shape', which is not supported; export without it")},
    {"glb_version_1.glb", refusal("binary glTF version 1; version 2 is read: convert the file")},
    {"glb_view_beyond_buffer.glb", refusal("buffer view 1: bytes 24 to 24 + 1000 are beyond the 72 of buffer 0")},
    {"glb_view_stride_1.glb", refusal("accessor 1: byteStride 1")},
    {"glb_without_asset.glb", refusal("JSON without 'asset' is not glTF")},
    {"glb_without_indices.glb", part(4, 4, "m", kVolume)},
    {"glb_without_positions.glb", refusal("has 1 primitive without positions and no triangle: nothing to compute on")},
    {"glb_without_scenes.glb", part(4, 4, "m", kVolume)},
    {"glb_zero_padded.glb", part(4, 4, "m", kVolume)},
    {"gltf_bad_base64.gltf", refusal("buffer 0: its data URI is not base64")},
    {"gltf_other_file.gltf",
     refusal(
         "buffer 0: its data is in the file 'mesh.bin', which cannot be opened: No such file or directory; export")},
    {"gltf_plain_data_uri.gltf", refusal("buffer 0: its data URI is not base64")},
    {"gltf_tetrahedron.gltf", part(4, 4, "m", kVolume)},
    {"gltf_without_extension", part(4, 4, "m", kVolume)},
};

double assemblyVolume(const Mesh& mesh) {
  double volume = 0;
  for (const Face& face : mesh.faces)
    volume += dot(mesh.vertices[face[0]], cross(mesh.vertices[face[1]], mesh.vertices[face[2]])) / 6;
  return volume;
}

}  // namespace

TEST_CASE("every file of the corpus of assemblies is read as the right mesh or rejected with the reason") {
  size_t fileCount = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ASDFVK_TEST_DIR "/io/assembly_corpus")) {
    const std::string name = entry.path().filename().string();
    CAPTURE(name);
    ++fileCount;
    REQUIRE(kAssemblyExpectations.contains(name));
    const AssemblyExpectation& expected = kAssemblyExpectations.at(name);
    const std::optional<Mesh> mesh = test::readAsExpected(entry.path(), expected.reason);
    const Mesh read = mesh.value_or(Mesh{});
    CHECK(read.vertices.size() == expected.vertexCount);
    CHECK(read.inputFaceCount() == expected.faceCount);
    CHECK(read.unit == expected.unit);
    CHECK(joined(read.skipped, ", ") == expected.skipped);
    CHECK(assemblyVolume(read) == doctest::Approx(expected.volume));
  }
  CHECK(fileCount == kAssemblyExpectations.size());
}

TEST_CASE("the nodes of glTF and the items of 3MF place their parts") {
  const std::string folder = ASDFVK_TEST_DIR "/io/assembly_corpus/";
  // Moved by 10 in x; the second instance is turned by 90 degrees about z and moved by 5 in y.
  const std::vector<Vec3d> instances = readMesh(folder + "glb_instances.glb").vertices;
  CHECK(instances[0] == Vec3d{10, 0, 0});
  CHECK(instances[1] == Vec3d{10, 2, 0});
  CHECK(instances[2] == Vec3d{12, 0, 0});
  CHECK(instances[4] == Vec3d{10, 5, 0});
  CHECK(length(instances[5] - Vec3d{9, 5, 0}) < 1e-15);
  CHECK(length(instances[6] - Vec3d{10, 6, 0}) < 1e-15);
  CHECK(readMesh(folder + "glb_matrix.glb").vertices[2] == Vec3d{1, 4, 3});
  const std::vector<Vec3d> components = readMesh(folder + "3mf_components.3mf").vertices;
  CHECK(components[1] == Vec3d{1, 0, 7});
  CHECK(components[5] == Vec3d{5, 1, 7});
  CHECK(components[6] == Vec3d{4, 0, 7});
  CHECK(readMesh(folder + "3mf_two_items.3mf").vertices[5] == Vec3d{12, 20, 30});
}

TEST_CASE("a file cut at any byte is an error of the reader") {
  for (const char* const name : {"glb_instances.glb", "gltf_tetrahedron.gltf", "3mf_zip64.3mf", "3mf_components.3mf"}) {
    CAPTURE(name);
    const std::filesystem::path path = std::filesystem::path(ASDFVK_TEST_DIR "/io/assembly_corpus") / name;
    const std::string bytes = contentOf(path);
    const std::string format = path.extension().string();
    for (size_t size = 1; size < bytes.size(); ++size) {
      CAPTURE(size);
      const std::string message = test::errorOf(format, bytes.substr(0, size));
      CHECK(message != "no error");
      CHECK(message != "an error of another kind");
    }
  }
}
