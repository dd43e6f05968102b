#pragma once

#include <string>
#include <string_view>

// Names of the members of a tar of samples, by the rules of WebDataset.
namespace asdfvk {

/// The name up to the first dot of its last part: "a/b.c/0001" for "a/b.c/0001.mesh.ply". Consecutive members with the
/// same key are a sample.
[[nodiscard]] std::string sampleKeyOf(std::string_view name);

/// Whether the extension is that of a mesh. False for hidden files and for results of this program (NAME.asdf.ply).
[[nodiscard]] bool isMeshMember(const std::string& name);

/// Whether a tar with the name can be unpacked without writing outside of its folder.
[[nodiscard]] bool isSafeMember(std::string_view name);

}  // namespace asdfvk
