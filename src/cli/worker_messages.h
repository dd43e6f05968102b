#pragma once

#include <string>
#include <string_view>

#include "cli/mesh_run.h"
#include "viewer/json.h"

/// What the main process and its worker processes send each other: lines of JSON.
namespace asdfvk {

/// Without the line end.
[[nodiscard]] std::string lineOf(const Json& json);

/// Bytes of any kind as UTF-8 text, a character per byte, so that JSON carries them; and back.
[[nodiscard]] std::string textOfBytes(std::string_view bytes);
[[nodiscard]] std::string bytesOfText(std::string_view text);

/// A mesh to compute; its size is not sent.
[[nodiscard]] Json requestOf(const MeshTask& task);
[[nodiscard]] MeshTask taskOf(const Json& request);

/// The result of a mesh; names in its record that are not UTF-8 are lost.
[[nodiscard]] Json answerOf(const MeshRun& run);
[[nodiscard]] MeshRun runOf(const Json& answer);

}  // namespace asdfvk
