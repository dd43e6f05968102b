#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json.h"
#include "serve/request_queue.h"

namespace asdfvk {

/// A file that a request makes.
struct RequestedFile {
  std::string path;               ///< Empty: the answer has the bytes of the file.
  Json options = Json::object();  ///< Further options of the file.
};

/// A key of a request with its JSON Schema.
struct RequestKey {
  const char* name;
  Json schema;
};
[[nodiscard]] const std::vector<RequestKey>& requestKeys();
[[nodiscard]] const Json& schemaOfKey(std::string_view name);

/// A request to compute a mesh. The mesh is a file, the bytes of a file, or arrays.
struct MeshRequest {
  std::string mesh;          ///< Path; empty: the request has the mesh.
  std::string format, data;  ///< Extension of a format, and the bytes of a file of this format as base64.
  Json vertices, faces;      ///< Lists of lists; null: none.
  Json options = Json::object();
  std::optional<RequestedFile> output, picture;
  std::vector<std::string> with;  ///< Paths of bodies beside the mesh.
  std::string former;             ///< Path of the former version of the mesh; empty: none.
  double timeoutSeconds = std::numeric_limits<double>::infinity();
};

/// Why a request has no report, or which requested check failed.
struct RequestFailure {
  std::string code;     ///< Name of the error, such as `unreadableInput` or `tooThin`.
  std::string message;  ///< The reason and the remedy, in one line.
  int exitCode = 0;     ///< Exit code of the program for the same failure.
};
ASDFVK_JSON_KEYS(RequestFailure, code, message, exitCode)
/// The failure of a request that is no request of the protocol.
[[nodiscard]] RequestFailure invalidRequest(const std::string& message);

/// A file in an answer.
struct AnsweredFile {
  std::string format;  ///< Extension of the format, such as `npy`.
  std::string data;    ///< The bytes of the file as base64.
};
ASDFVK_JSON_KEYS(AnsweredFile, format, data)

struct MeshAnswer {
  std::string report;  ///< The JSON report in one line; empty if the mesh was not computed.
  /// Why the mesh was not computed, or which requested check failed.
  std::optional<RequestFailure> failure;
  std::optional<AnsweredFile> output, picture;                 ///< Files without a path.
  std::vector<std::pair<std::string, std::string>> rows = {};  ///< The report as texts: title and text.
};

/// Computes requests.
class RequestComputer {
 public:
  virtual ~RequestComputer() = default;
  /// Thread-safe for different workers. Does not throw. progress: called with 0 to 1; may be empty.
  [[nodiscard]] virtual MeshAnswer compute(const MeshRequest& request, const RequestContext& context,
                                           const std::function<void(double)>& progress) = 0;
};

/// Parses JSON. Throws Error{UnreadableInput} for other texts, and for lists and objects that are nested too deeply.
[[nodiscard]] Json parsedRequest(const std::string& text);

/// Throws Error{UnknownName} for a key that is not in `names`, with similar names. owner: the object, for the message.
void requireKeys(const Json& object, const std::vector<std::string>& names, const char* owner);

/// Reads the keys of a request, except "id". Throws Error{UnknownName} for unknown keys, and Error{OptionConflict} for
/// values of other types, and for no mesh or several ones.
[[nodiscard]] MeshRequest meshRequestOf(const Json& json);

}  // namespace asdfvk
