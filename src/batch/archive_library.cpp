#include "batch/archive_library.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include "asdf_vk/error.h"

namespace asdfvk {
namespace {

constexpr const char* kArchiveLibrary = "libarchive.so.13";  // The same in Debian 12 and 13.

[[noreturn]] void failArchiveLibrary() {
  const char* const reason = ::dlerror();
  throw Error(ErrorCode::UnreadableInput,
              fmt::format("--tar needs libarchive, which cannot be loaded ({}); install the package libarchive13",
                          reason == nullptr ? kArchiveLibrary : reason));
}

ArchiveLibrary loadedArchiveLibrary() {
  void* const handle = ::dlopen(kArchiveLibrary, RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) failArchiveLibrary();
  ArchiveLibrary library;
  const auto load = [handle](auto& field, const char* name) {
    field = reinterpret_cast<std::remove_reference_t<decltype(field)>>(::dlsym(handle, name));
    if (field == nullptr) failArchiveLibrary();
  };
#define ASDFVK_ARCHIVE_LOAD(field, function) load(library.field, #function);
  ASDFVK_ARCHIVE_FUNCTIONS(ASDFVK_ARCHIVE_LOAD)
#undef ASDFVK_ARCHIVE_LOAD
  return library;
}

}  // namespace

const ArchiveLibrary& archiveLibrary() {
  static const ArchiveLibrary library = loadedArchiveLibrary();
  return library;
}

}  // namespace asdfvk
