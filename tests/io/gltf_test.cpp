#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "gltf_building.h"
#include "reading.h"

namespace asdfvk {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// An empty folder, which is removed at the end.
/// A document whose buffer is in a file.
std::string documentWithUri(const test::PlainMesh& mesh, const std::string& uri) {
  json document = test::documentOf(mesh);
  document["buffers"][0]["uri"] = uri;
  return document.dump();
}

std::string errorOfFile(const fs::path& path) {
  try {
    (void)readMesh(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string skippedOf(const std::string& bytes) { return joined(test::parse("glb", bytes).skipped, ", "); }

}  // namespace

TEST_CASE("glTF: a file may have 100,000 nodes, side by side or in a chain, and as many other objects") {
  json document = test::documentOf(test::box());
  constexpr uint32_t kNodeCount = 100'000;
  document["nodes"] = json::array();
  document["scenes"][0]["nodes"] = json::array();
  for (uint32_t i = 0; i < kNodeCount; ++i) {
    document["nodes"].push_back({{"mesh", 0}, {"translation", {i, 0, 0}}});
    document["scenes"][0]["nodes"].push_back(i);
  }
  const std::string bytes = test::glbOf(document, test::binaryOf(test::box()));
  CHECK(test::parse("glb", bytes).faceCount() == 12 * kNodeCount);
  document["scenes"][0]["nodes"] = {0};  // A chain of nodes.
  for (uint32_t i = 0; i + 1 < kNodeCount; ++i) document["nodes"][i]["children"] = {i + 1};
  CHECK(test::parse("glb", test::glbOf(document, test::binaryOf(test::box()))).faceCount() == 12 * kNodeCount);
  std::string objects = "{\"asset\":{\"version\":\"2.0\"},\"extras\":[";
  for (uint32_t i = 0; i < kNodeCount; ++i) objects += "{\"\":0},";
  CHECK(test::holds(test::errorOf("glb", objects + "0]}"), "no mesh and no triangle"));
}

TEST_CASE("glTF: JSON with two members of one name is refused") {
  const std::string message =
      test::errorOf("gltf", R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"nodes":[],"meshes":[]})");
  CHECK(message == "a JSON object has the name 'nodes' twice");
}

TEST_CASE("glTF: the data of a .gltf file may be in files beside it and in folders below") {
  const test::GltfFolder folder;
  const test::PlainMesh grid = test::curvedGrid(20);
  const Mesh expected = test::parse("glb", test::glbOf(grid));
  for (const auto& [uri, file] : {std::pair{"mesh.bin", "mesh.bin"},
                                  {"a%20part%23.bin", "a part#.bin"},
                                  {"100%.bin", "100%.bin"},
                                  {"./buffers/of/mesh.bin", "buffers/of/mesh.bin"},
                                  {"\xc3\xa4.bin", "\xc3\xa4.bin"}}) {
    const std::string shown = uri;  // Clang 14 captures no structured binding.
    CAPTURE(shown);
    (void)folder.write(file, test::binaryOf(grid));
    const Mesh mesh = readMesh(folder.write("mesh.gltf", documentWithUri(grid, uri)));
    CHECK(mesh.vertices == expected.vertices);
    CHECK(mesh.faces == expected.faces);
    CHECK(mesh.skipped.empty());
  }
  // The limit of faces counts the bytes of both files: 125,000 faces are too many for the document alone.
  const test::PlainMesh large = test::curvedGrid(250);
  (void)folder.write("large.bin", test::binaryOf(large));
  CHECK(readMesh(folder.write("large.gltf", documentWithUri(large, "large.bin"))).faceCount() == 125'000);
  // A name without a folder is relative to the current folder.
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  CHECK(readMesh("mesh.gltf").faceCount() == 800);
  fs::current_path(before);
}

TEST_CASE("glTF: no file outside of the folder is read, and no file that is not regular") {
  const test::GltfFolder outer;
  const test::PlainMesh box = test::box();
  (void)outer.write("mesh.bin", test::binaryOf(box));
  (void)outer.write("inner/short.bin", "too short");
  (void)outer.write("inner/below/mesh.bin", test::binaryOf(box));
  const fs::path inner = outer.path() / "inner";
  fs::create_symlink(outer.path() / "mesh.bin", inner / "link.bin");
  fs::create_symlink(outer.path(), inner / "linked");
  fs::create_symlink("below/mesh.bin", inner / "inside.bin");
  REQUIRE(::mkfifo((inner / "fifo.bin").c_str(), 0600) == 0);
  const auto refused = [&](const std::string& uri) {
    const std::string message = errorOfFile(outer.write("inner/mesh.gltf", documentWithUri(box, uri)));
    return message.substr(message.find("buffer 0"));
  };
  const std::string notRelative = "which is not a relative name in the folder of this file; export as .glb";
  for (const char* const uri : {"../mesh.bin", "below/../../mesh.bin", "%2e%2e/mesh.bin", "..%2fmesh.bin", "",
                                "/etc/passwd", "%2Fetc/passwd", "..\\mesh.bin", "c:\\mesh.bin", "file:///etc/passwd",
                                "http://host/mesh.bin", "//host/mesh.bin", "mesh%00.bin", "mesh%0a.bin"}) {
    CAPTURE(uri);
    CHECK(refused(uri).ends_with(notRelative));
  }
  const std::string link = "a link to another folder; export as .glb, or copy the file";
  CHECK(refused("link.bin") == "buffer 0: its data is in the file 'link.bin', " + link);
  CHECK(refused("linked/mesh.bin").ends_with(link));
  CHECK(readMesh(outer.write("inner/mesh.gltf", documentWithUri(box, "inside.bin"))).faceCount() == 12);
  CHECK(refused("fifo.bin") == "buffer 0: the file 'fifo.bin' is not a regular file");
  CHECK(refused("below") == "buffer 0: the file 'below' is not a regular file");
  CHECK(
      test::holds(refused("none.bin"), "cannot be opened: No such file or directory; export as .glb, or add the file"));
  CHECK(refused("short.bin") == "buffer 0: byteLength 240; its data has 9 bytes");
  const std::string message = test::errorOf("gltf", documentWithUri(box, "mesh.bin"));
  CHECK(message ==
        "buffer 0: its data is in the file 'mesh.bin', which is read only beside a named file; export as "
        ".glb, or read the file by its path");
}

TEST_CASE("glTF: bytes after the end of the file or of a buffer are reported") {
  const test::GltfFolder folder;
  const test::PlainMesh box = test::box();
  CHECK(skippedOf(test::glbOf(box) + "rubbish") == "7 bytes after the end");
  (void)folder.write("mesh.bin", test::binaryOf(box) + "pad");
  CHECK(readMesh(folder.write("mesh.gltf", documentWithUri(box, "mesh.bin"))).skipped.empty());
  (void)folder.write("mesh.bin", test::binaryOf(box) + "rubbish");
  CHECK(joined(readMesh(folder.write("mesh.gltf", documentWithUri(box, "mesh.bin"))).skipped, ", ") ==
        "7 bytes after the end of a buffer");
}

TEST_CASE("glTF: primitives without vertices and hidden nodes beside a good mesh are skipped and reported") {
  const test::PlainMesh box = test::box();
  const auto skipped = [&](const std::function<void(json&)>& change) {
    json document = test::documentOf(box);
    change(document);
    const Mesh mesh = test::parse("glb", test::glbOf(document, test::binaryOf(box)));
    CHECK(mesh.faceCount() == 12);
    CHECK(mesh.statedPartCount == 1);
    return joined(mesh.skipped, ", ");
  };
  const auto addPrimitive = [](json& document, const json& primitive) {
    document["meshes"][0]["primitives"].push_back(primitive);
  };
  CHECK(skipped([&](json& d) {
          addPrimitive(d, {{"attributes", json::object()}});
          addPrimitive(d, {{"indices", 1}});
        }) == "2 primitives without positions");
  CHECK(skipped([&](json& d) {
          d["accessors"].push_back({{"componentType", 5126}, {"count", 0}, {"type", "VEC3"}, {"bufferView", 0}});
          d["accessors"].push_back({{"componentType", 5125}, {"count", 0}, {"type", "SCALAR"}});
          addPrimitive(d, {{"attributes", {{"POSITION", 2}}}});
          addPrimitive(d, {{"attributes", {{"POSITION", 0}}}, {"indices", 3}});
        }) == "2 primitives without vertices");
  CHECK(skipped([&](json& d) {
          d["meshes"].push_back({{"name", "empty"}});
          d["meshes"].push_back({{"primitives", json::array()}});
          d["nodes"].push_back({{"mesh", 1}});
          d["nodes"].push_back({{"mesh", 2}});
          d["scenes"][0]["nodes"] = {0, 1, 2};
        }) == "2 meshes without primitives");
  CHECK(skipped([&](json& d) {
          d["extensionsRequired"] = {"KHR_node_visibility"};
          d["nodes"].push_back({{"children", {2}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
          d["nodes"].push_back(
              {{"mesh", 0},
               {"extensions",
                {{"KHR_node_visibility", {{"visible", true}}}, {"EXT_mesh_gpu_instancing", json::object()}}}});
          d["scenes"][0]["nodes"] = {0, 1};
        }) == "1 hidden node");
}

TEST_CASE("glTF: faces have the name of their node, or else of their mesh") {
  json document = test::documentOf(test::box());
  document["meshes"].push_back(document["meshes"][0]);
  document["meshes"][1]["name"] = "mesh name";
  document["meshes"].push_back({{"name", "without primitives"}});
  document["nodes"] = {{{"mesh", 0}, {"name", "left\narm"}},
                       {{"mesh", 0}},
                       {{"mesh", 1}, {"name", ""}},
                       {{"mesh", 2}, {"name", "without faces"}},
                       {{"mesh", 1}},
                       {{"name", "group"}, {"children", {6}}},
                       {{"mesh", 1}, {"name", "Geh\u00e4use"}},
                       {{"mesh", 0}, {"name", 7}}};
  document["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5, 7};
  const Mesh mesh = test::parse("glb", test::glbOf(document, test::binaryOf(test::box())));
  CHECK(mesh.faceCount() == 72);
  CHECK(mesh.objects ==
        std::vector<NamedFaces>{{0, "left arm"}, {12, ""}, {24, "mesh name"}, {48, "Geh\u00e4use"}, {60, ""}});
}

TEST_CASE("glTF: an accessor of one element more than its buffer view has is refused") {
  const test::PlainMesh box = test::box();
  for (const size_t accessor : {size_t{0}, size_t{1}})
    for (const uint32_t more : {0u, 1u}) {
      CAPTURE(accessor);
      json document = test::documentOf(box);
      json& count = document["accessors"][accessor]["count"];
      count = count.get<uint32_t>() + more;
      const std::string bytes = test::glbOf(document, test::binaryOf(box));
      if (more == 0)
        CHECK(test::parse("glb", bytes).faceCount() == 12);
      else
        CHECK(test::holds(test::errorOf("glb", bytes), "do not fit into the"));
    }
}

TEST_CASE("glTF: an accessor without a buffer view has zeros") {
  json document = test::documentOf(test::box());
  document["accessors"][0].erase("bufferView");
  const Mesh mesh = test::parse("glb", test::glbOf(document, test::binaryOf(test::box())));
  CHECK(mesh.faceCount() == 12);
  CHECK(mesh.vertices == std::vector<Vec3d>{{0, 0, 0}});
}

TEST_CASE("glTF: instances within the limit of faces meet the limit of memory") {
  json document = test::documentOf(test::box());
  document["nodes"] = json(100'000, {{"mesh", 0}});
  document["meshes"][0]["primitives"] = json(100, document["meshes"][0]["primitives"][0]);
  document.erase("scenes");
  const std::string bytes = test::glbOf(document, test::binaryOf(test::box()));
  try {
    (void)parseMesh(bytes, {.maxFaces = 1'000'000'000});
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::InputTooLarge);
    CHECK(test::holds(error.what(), "its instances have 120,000,000 faces in all, which need more than 1024 MiB"));
  }
}

TEST_CASE("glTF: a small file that describes many faces or sparse elements is refused before the work is done") {
  const test::PlainMesh box = test::box();
  json document = test::documentOf(box);
  std::vector<uint32_t> places(100'000);
  for (uint32_t i = 0; i < places.size(); ++i) places[i] = i;
  const std::string binary = test::binaryOf(box) + test::bytesOf(places) + std::string(12 * places.size(), '\0');
  document["buffers"][0]["byteLength"] = binary.size();
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 240}, {"byteLength", 4 * places.size()}});
  document["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", 240 + 4 * places.size()}, {"byteLength", 12 * places.size()}});
  const json sparse{{"componentType", 5126},
                    {"count", 99'999},
                    {"type", "VEC3"},
                    {"sparse",
                     {{"count", 99'999},
                      {"indices", {{"bufferView", 2}, {"componentType", 5125}}},
                      {"values", {{"bufferView", 3}}}}}};
  document["accessors"].push_back(sparse);
  json many = document;
  many["meshes"][0]["primitives"] = json::array();
  for (uint32_t i = 0; i < 20'000; ++i) many["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 2}}}});
  const std::string oneAccessor = test::glbOf(many, binary);
  CHECK(test::holds(test::errorOf("glb", oneAccessor), "has 666,660,000 faces; the limit for a file of"));

  // An accessor for each primitive, whose three corners are few faces.
  for (uint32_t i = 0; i < 20'000; ++i) {
    document["accessors"].push_back(sparse);
    document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 3 + i}}}, {"indices", 1}});
  }
  const std::string manyAccessors = test::glbOf(document, binary);
  CHECK(test::holds(test::errorOf("glb", manyAccessors), "the sparse parts of this file have more elements than"));
}

TEST_CASE("glTF: the steps of float32 positions are those before the transform of a node") {
  test::PlainMesh far = test::box();
  for (size_t i = 0; i < far.positions.size(); i += 3) far.positions[i] += 5e6f;  // Steps of 0.5.
  json document = test::documentOf(far);
  const auto stepOf = [&] { return test::parse("glb", test::glbOf(document, test::binaryOf(far))).float32Step; };
  CHECK(stepOf() == 0.5);
  document["nodes"][0]["translation"] = {-5e6, 0, 0};
  CHECK(stepOf() == 0.5);
  document["nodes"][0]["scale"] = {0.001, 0.001, 0.001};
  CHECK(stepOf() == doctest::Approx(0.0005));
}

}  // namespace asdfvk
