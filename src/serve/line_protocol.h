#pragma once

#include "serve/mesh_request.h"
#include "serve/request_queue.h"
#include "serve/request_streams.h"

namespace asdfvk {

/// The answer to a request for a mesh that was computed.
struct ReportAnswer {
  int formatVersion = kJsonFormatVersion;     ///< Version of the format of JSON documents.
  Json id;                                    ///< That of the request.
  OptionalKey<RequestFailure> failure;        ///< The requested check that failed; exists only then.
  OptionalKey<AnsweredFile> output, picture;  ///< A file of the answer; exists only if it was requested.
  Json report;                                ///< The JSON report. The paths of files of the answer are null.
};
ASDFVK_JSON_KEYS(ReportAnswer, formatVersion, id, failure, output, picture, report)

/// The answer to a request for a mesh that was not computed.
struct ErrorAnswer {
  int formatVersion = kJsonFormatVersion;  ///< Version of the format of JSON documents.
  Json id;                                 ///< That of the request; null if the line is not JSON.
  RequestFailure error;                    ///< Why the mesh was not computed.
};
ASDFVK_JSON_KEYS(ErrorAnswer, formatVersion, id, error)

/// The answer to a cancel.
struct CancelAnswer {
  int formatVersion = kJsonFormatVersion;  ///< Version of the format of JSON documents.
  Json cancel;                             ///< That of the request.
  bool found;                              ///< Whether a request with this id was open.
};
ASDFVK_JSON_KEYS(CancelAnswer, formatVersion, cancel, found)

/// The protocol of `asdf-vk serve` (docs/serve.md): one request and one answer per line.
class LineProtocol {
 public:
  /// The arguments must outlive the requests in the queue.
  LineProtocol(RequestQueue& queue, RequestComputer& computer) : queue_(queue), computer_(computer) {}

  /// Adds the request of the line to the queue, or cancels a request. Invalid requests are also answered in turn.
  void receive(const RequestLine& line);

 private:
  void receiveObject(const Json& json, size_t byteCount);
  void refuse(const Json& id, const std::string& message);

  RequestQueue& queue_;
  RequestComputer& computer_;
};

}  // namespace asdfvk
