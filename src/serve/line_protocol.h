#pragma once

#include "serve/mesh_request.h"
#include "serve/request_queue.h"
#include "serve/request_streams.h"

namespace asdfvk {

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
