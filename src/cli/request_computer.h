#pragma once

#include <limits>

#include "cli/memory_limit.h"
#include "cli/request_line.h"
#include "cli/request_sessions.h"
#include "serve/mesh_request.h"

namespace asdfvk {

struct ServerSettings {
  SessionSettings session;
  RequestFiles files;
  uint64_t maxMemoryBytes = 0;  ///< 0: no limit.
  double timeoutSeconds = std::numeric_limits<double>::infinity();
  size_t workerCount = 1;
  bool describesInText = false;  ///< Whether answers have MeshAnswer::rows.
};

/// Computes requests as the command line computes a mesh.
class MeshRequestComputer : public RequestComputer {
 public:
  explicit MeshRequestComputer(ServerSettings settings);

  [[nodiscard]] MeshAnswer compute(const MeshRequest& request, const RequestContext& context,
                                   const std::function<void(double)>& progress) override;

 private:
  [[nodiscard]] MeshAnswer computeWithin(const MeshRequest& request, const RequestContext& context,
                                         const std::function<void(double)>& progress, double timeoutSeconds,
                                         const class Deadline& deadline);

  const ServerSettings settings_;
  RequestSessions sessions_;
  MemoryLimit memory_;
};

}  // namespace asdfvk
