// Writes a mesh with tinygltf: two nodes, one below the other, with a matrix and with translation, rotation and scale.
//   tinygltf VERTICES FACES OUTPUT     # raw float32 (n, 3) and uint32 (m, 3); OUTPUT: .glb or .gltf
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <fstream>
#include <iterator>

static std::vector<unsigned char> contentOf(const char* path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int main(int, char** arguments) {
  const std::vector<unsigned char> positions = contentOf(arguments[1]), indices = contentOf(arguments[2]);
  const std::string output = arguments[3];
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.buffers.emplace_back();
  model.buffers[0].data = indices;
  model.buffers[0].data.insert(model.buffers[0].data.end(), positions.begin(), positions.end());
  for (const bool isIndex : {true, false}) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = isIndex ? 0 : indices.size();
    view.byteLength = isIndex ? indices.size() : positions.size();
    model.bufferViews.push_back(view);
    tinygltf::Accessor accessor;
    accessor.bufferView = isIndex ? 0 : 1;
    accessor.componentType = isIndex ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT : TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = isIndex ? TINYGLTF_TYPE_SCALAR : TINYGLTF_TYPE_VEC3;
    accessor.count = isIndex ? indices.size() / 4 : positions.size() / 12;
    model.accessors.push_back(accessor);
  }
  tinygltf::Primitive primitive;
  primitive.indices = 0;
  primitive.attributes["POSITION"] = 1;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  model.meshes.emplace_back();
  model.meshes[0].primitives.push_back(primitive);
  model.nodes.resize(2);
  model.nodes[0].children = {1};
  model.nodes[0].matrix = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1};  // Twice as large, moved.
  model.nodes[1].mesh = 0;
  model.nodes[1].translation = {0, 0, 5};
  model.nodes[1].rotation = {0, 0, 0.6, 0.8};
  model.nodes[1].scale = {1, -1, 1};  // Mirrored.
  model.scenes.emplace_back();
  model.scenes[0].nodes = {0};
  model.defaultScene = 0;
  const bool isBinary = output.ends_with(".glb");
  return tinygltf::TinyGLTF().WriteGltfSceneToFile(&model, output, true, true, true, isBinary) ? 0 : 1;
}
