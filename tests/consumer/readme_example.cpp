// The example of README.md, compiled and run by the tests of consumers.
#include <asdf_vk/asdf_vk.h>

#include <iostream>

int main(int argc, char** argv) {
  const char* path = argc > 1 ? argv[1] : "horse.ply";
  // [README]
  asdfvk::Session session;                     // opens the device once, for many meshes
  asdfvk::Mesh mesh = asdfvk::readMesh(path);  // or asdfvk::MeshView of your own arrays
  asdfvk::Options options;
  options.seeds = asdfvk::SeedCount::ofShare(0.05);
  asdfvk::Result result = session.compute(mesh, options);
  std::cout << session.deviceLines()[0] << "\n"
            << "diameter of face 0: " << result.sdf()[0] << ", median " << result.report.sdf.median << "\n";
  asdfvk::writeResult("result.vtu", mesh, result.fields);
  // [README]
}
