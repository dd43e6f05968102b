#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "batch/mesh_record.h"

namespace asdfvk {

/// A mesh of a batch and the path of its result.
struct Job {
  std::string input, output;  ///< Paths; "-" for the standard streams.
  uint64_t byteCount = 0;     ///< Size of the input file; 0 if unknown.
  bool isStream = false;  ///< Whether the input is not a regular file, for example a FIFO. A worker may be unable to
                          ///< read such a file.
  std::string key;        ///< InputFile::key
  std::string picture;    ///< Path of the picture; empty: none.
  uint32_t attemptCount = 1;           ///< Number of attempts, with this one.
  std::optional<std::string> content;  ///< The bytes of the mesh if it is a member of a tar; then `output` is a name.
};

/// The result of a job. The texts are empty or consist of complete lines.
struct JobResult {
  MeshRecord record;
  std::string report;                                      ///< Text for standard output.
  std::string messages;                                    ///< Text for standard error.
  std::vector<std::pair<std::string, std::string>> files;  ///< Results of a member of a tar: names and bytes.
};

struct ComputerDescription {
  std::string backend;
  std::string deviceLines;
  bool isCpu = true;
};

ASDFVK_JSON(Job, input, output, key, picture, attemptCount, content)  // The members that a worker needs.
ASDFVK_JSON(JobResult, record, report, messages, files)
ASDFVK_JSON(ComputerDescription, backend, deviceLines, isCpu)

/// Computes jobs on a device that stays open.
class JobComputer {
 public:
  virtual ~JobComputer() = default;
  [[nodiscard]] virtual ComputerDescription describe() const = 0;
  /// Computes a job. Failures are part of the result. next: the following job, or null. Its input may be read ahead.
  [[nodiscard]] virtual JobResult compute(const Job& job, const Job* next) = 0;
  /// True if this computer can compute no further job, because its device failed or a stop was requested.
  [[nodiscard]] virtual bool isSpent() const = 0;
};

struct OpenFailure : std::runtime_error {
  OpenFailure(int exitCode, std::string errorName, const std::string& message)
      : std::runtime_error(message), code(exitCode), name(std::move(errorName)) {}
  int code;          ///< Exit code.
  std::string name;  ///< See MeshRecord::error.
};

}  // namespace asdfvk
