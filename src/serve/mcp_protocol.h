#pragma once

#include <memory>
#include <string>

#include "serve/mesh_request.h"
#include "serve/request_queue.h"
#include "serve/request_streams.h"

namespace asdfvk {

/// The Model Context Protocol over standard streams, as a server with tools (docs/mcp.md): JSON-RPC 2.0, one message
/// per line. Source: the specifications 2024-11-05 to 2025-11-25 on modelcontextprotocol.io.
class McpProtocol {
 public:
  /// The arguments must outlive the requests in the queue.
  McpProtocol(RequestQueue& queue, RequestComputer& computer) : queue_(queue), computer_(computer) {}

  /// Answers the line, or adds its request to the queue.
  void receive(const RequestLine& line);

 private:
  /// Sends the answers of one line: at once, or for a list of messages as one list.
  class Reply;

  void receiveMessage(const Json& message, size_t byteCount, const std::shared_ptr<Reply>& reply);
  /// The answer to a request other than a call of a tool.
  [[nodiscard]] Json resultOf(const std::string& method, const Json& params);
  void callTool(const Json& id, const Json& params, size_t byteCount, const std::shared_ptr<Reply>& reply);

  RequestQueue& queue_;
  RequestComputer& computer_;
  std::string version_;  ///< The negotiated version; empty before the request "initialize".
};

}  // namespace asdfvk
