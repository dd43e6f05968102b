#include "io/step_library.h"

#include <dlfcn.h>
#include <fmt/core.h>
#include <link.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "io/input_failure.h"

namespace asdfvk {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModuleName = "libasdf-vk-step.so";

/// The folder of the program or shared library that contains this function; empty if unknown.
fs::path ownFolder() {
  Dl_info info{};
  link_map* object = nullptr;
  if (::dladdr1(reinterpret_cast<void*>(&stepModule), &info, reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP) == 0)
    return {};
  std::error_code ignored;  // The name of the program is empty.
  const bool isProgram = object == nullptr || object->l_name == nullptr || *object->l_name == 0;
  return fs::canonical(isProgram ? "/proc/self/exe" : object->l_name, ignored).parent_path();
}

std::vector<fs::path> modulePaths() {
  if (const char* named = ::secure_getenv("ASDF_VK_STEP_MODULE")) return {named};
  std::vector<fs::path> paths;
  if (const fs::path folder = ownFolder(); !folder.empty())
    paths = {folder / kModuleName, folder.parent_path() / ASDFVK_LIBDIR / "asdf-vk" / kModuleName};
  paths.push_back(fs::path(ASDFVK_FULL_LIBDIR) / "asdf-vk" / kModuleName);
  return paths;
}

}  // namespace

StepModuleFunction stepModule() {
  constexpr const char* kRemedy = "export STL or 3MF, or install asdf-vk-step (docs/formats.md)";
  for (const fs::path& path : modulePaths()) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) continue;
    // Never closed, because Open CASCADE keeps state until the process ends.
    void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const function = library == nullptr ? nullptr : ::dlsym(library, kStepModuleFunction);
    if (function != nullptr) return reinterpret_cast<StepModuleFunction>(function);
    const char* const reason = ::dlerror();
    failInput(
        fmt::format("is STEP, and its module cannot be loaded ({}); {}", reason == nullptr ? "" : reason, kRemedy));
  }
  failInput(fmt::format("is STEP, which is read by a module that is not installed ({}); {}", kModuleName, kRemedy));
}

}  // namespace asdfvk
