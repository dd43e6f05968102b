// Writes a mesh with lib3mf 1.8, in inches: an object of two components, which a build item moves.
//   lib3mf VERTICES FACES OUTPUT     # raw float32 (n, 3) and uint32 (m, 3)
#include <Model/COM/NMR_DLLInterfaces.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

using namespace NMR;

static void require(LIB3MFRESULT result, int line) {
  if (result == 0) return;
  std::cerr << "lib3mf failed in line " << line << "\n";
  std::exit(1);
}
#define REQUIRE(call) require(call, __LINE__)

template <typename T>
static std::vector<T> contentOf(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  const T* const first = reinterpret_cast<const T*>(bytes.data());
  return {first, first + bytes.size() / sizeof(T)};
}

int main(int, char** arguments) {
  std::vector<MODELMESHVERTEX> vertices = contentOf<MODELMESHVERTEX>(arguments[1]);
  std::vector<MODELMESHTRIANGLE> triangles = contentOf<MODELMESHTRIANGLE>(arguments[2]);
  PLib3MFModel* model = nullptr;
  REQUIRE(lib3mf_createmodel(&model));
  REQUIRE(lib3mf_model_setunit(model, MODELUNIT_INCH));
  PLib3MFModelMeshObject* mesh = nullptr;
  REQUIRE(lib3mf_model_addmeshobject(model, &mesh));
  REQUIRE(lib3mf_meshobject_setgeometry(mesh, vertices.data(), static_cast<DWORD>(vertices.size()), triangles.data(),
                                        static_cast<DWORD>(triangles.size())));
  PLib3MFModelComponentsObject* both = nullptr;
  REQUIRE(lib3mf_model_addcomponentsobject(model, &both));
  // Rows of the transform: x, y and z of the image, the last column is the translation.
  MODELTRANSFORM turned = {{{0, -1, 0, 10}, {1, 0, 0, 20}, {0, 0, 1, 30}}};
  MODELTRANSFORM larger = {{{3, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, 3, 0}}};
  PLib3MFModelComponent* component = nullptr;
  REQUIRE(lib3mf_componentsobject_addcomponent(both, mesh, nullptr, &component));
  REQUIRE(lib3mf_componentsobject_addcomponent(both, mesh, &turned, &component));
  PLib3MFModelBuildItem* item = nullptr;
  REQUIRE(lib3mf_model_addbuilditem(model, both, &larger, &item));
  PLib3MFModelWriter* writer = nullptr;
  REQUIRE(lib3mf_model_querywriter(model, "3mf", &writer));
  REQUIRE(lib3mf_writer_writetofileutf8(writer, arguments[3]));
}
