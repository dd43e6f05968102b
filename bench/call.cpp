// For each line of standard input, runs Session::compute() on the arrays of a mesh and prints the seconds.
// bench/python_call.py runs this program in turns with the Python module. Usage: asdfvk-bench-call MESH [BACKEND]
#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <string>

#include "asdf_vk/asdf_vk.h"
#include "core/stopwatch.h"

int main(int argc, char** argv) {
  const auto* const backend = asdfvk::findChoice(asdfvk::kBackendNames, argc > 2 ? argv[2] : "auto");
  if (argc < 2 || backend == nullptr) {
    std::cerr << "usage: asdfvk-bench-call MESH [BACKEND]\n";
    return 1;
  }
  const asdfvk::Mesh mesh = asdfvk::readMesh(argv[1]);
  asdfvk::Session session({.backend = *backend, .device = {}, .variant = {}});
  for (std::string line; std::getline(std::cin, line);) {
    const asdfvk::Stopwatch watch;
    const asdfvk::Result result = session.compute(mesh);
    fmt::print("{}\n", watch.seconds());
    std::fflush(stdout);
  }
  return 0;
}
