#pragma once

#include <string>
#include <string_view>

#include "cli/mesh_run.h"
#include "core/json.h"

/// What the main process and its worker processes send each other: lines of JSON.
namespace asdfvk {

/// Without the line end.
[[nodiscard]] std::string lineOf(const Json& json);

/// Arbitrary bytes as UTF-8 text, one character per byte, for JSON; and the inverse.
[[nodiscard]] std::string textOfBytes(std::string_view bytes);
[[nodiscard]] std::string bytesOfText(std::string_view text);

/// A mesh to compute; its size is not sent.
[[nodiscard]] Json requestOf(const MeshTask& task);
[[nodiscard]] MeshTask taskOf(const Json& request);

/// The result of a mesh. Bytes of its record that are not UTF-8 are replaced, except in the input.
[[nodiscard]] Json answerOf(const MeshRun& run);
[[nodiscard]] MeshRun runOf(const Json& answer);

}  // namespace asdfvk
