#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace asdfvk {

/// A ZIP archive of a model of 3MF, not compressed and without checksums: a fuzzer changes the model itself. The text
/// from "<config" on is the settings of a slicer, in both files that may have them.
inline std::string storedArchive(std::string_view text) {
  const std::string_view model = text.substr(0, text.find("<config")), settings = text.substr(model.size());
  constexpr std::string_view kRelationships =
      "<Relationships><Relationship Target='/3D/3dmodel.model' "
      "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></Relationships>";
  std::string archive, directory;
  const auto put = [](std::string& to, uint64_t number, size_t size) {
    for (size_t i = 0; i < size; ++i) to += static_cast<char>(i < sizeof number ? number >> (8 * i) & 0xff : 0);
  };
  const auto add = [&](std::string_view name, std::string_view contents) {
    const uint64_t offset = archive.size();
    std::string common;
    put(common, 20, 2);
    put(common, 0, 12);  // Flags, method, time and date, checksum.
    put(common, contents.size(), 4);
    put(common, contents.size(), 4);
    put(common, name.size(), 2);
    put(common, 0, 2);
    put(archive, 0x04034b50, 4);
    archive.append(common).append(name).append(contents);
    put(directory, 0x02014b50, 4);
    put(directory, 20, 2);
    directory += common;
    put(directory, 0, 10);
    put(directory, offset, 4);
    directory.append(name);
  };
  add("_rels/.rels", kRelationships);
  add("3D/3dmodel.model", model);
  uint64_t count = 2;
  if (!settings.empty()) {
    add("Metadata/Slic3r_PE_model.config", settings);
    add("Metadata/model_settings.config", settings);
    count = 4;
  }
  const uint64_t offset = archive.size();
  archive += directory;
  put(archive, 0x06054b50, 4);
  put(archive, 0, 4);
  put(archive, count, 2);
  put(archive, count, 2);
  put(archive, directory.size(), 4);
  put(archive, offset, 4);
  put(archive, 0, 2);
  return archive;
}

}  // namespace asdfvk
