#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "batch/mesh_record.h"

namespace asdfvk {

/// A mesh of a batch and the path of its result.
struct Job {
  std::string input, output;  ///< "-" for the standard streams.
  uint64_t byteCount = 0;     ///< Size of the input; 0 where it is unknown.
  bool isStream = false;      ///< The input is no regular file, so that another process may not be able to read it.
};

/// What a job leaves. The texts are empty or consist of complete lines.
struct JobResult {
  MeshRecord record;
  std::string report;    ///< For standard output.
  std::string messages;  ///< For standard error.
};

/// What computes jobs, as the monitor shows it.
struct ComputerDescription {
  std::string backend;
  std::string deviceLines;
  bool isCpu = true;
};

ASDFVK_JSON(Job, input, output)  // What a worker needs.
ASDFVK_JSON(JobResult, record, report, messages)
ASDFVK_JSON(ComputerDescription, backend, deviceLines, isCpu)

/// Computes jobs with a device that it keeps open.
class JobComputer {
 public:
  virtual ~JobComputer() = default;
  [[nodiscard]] virtual ComputerDescription describe() const = 0;
  /// A failure is part of the result. `next`: the job that follows, which may be read ahead, or null.
  [[nodiscard]] virtual JobResult compute(const Job& job, const Job* next) = 0;
  /// Whether the device failed, so that further jobs need another computer.
  [[nodiscard]] virtual bool isSpent() const = 0;
};

/// Why no computer can be opened.
struct OpenFailure : std::runtime_error {
  OpenFailure(int exitCode, std::string errorName, const std::string& message)
      : std::runtime_error(message), code(exitCode), name(std::move(errorName)) {}
  int code;          ///< Exit code.
  std::string name;  ///< See MeshRecord::error.
};

}  // namespace asdfvk
