#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "asdf_vk/run_control.h"

namespace CLI {
class App;
}

namespace asdfvk::bench {

inline constexpr int kCancelledExitCode = 130;

/// Allowed values of an option, including both ends.
template <typename T>
struct Range {
  T min = std::numeric_limits<T>::lowest(), max = std::numeric_limits<T>::max();

  friend bool operator==(const Range&, const Range&) = default;
};

/// The command line and the error handling of a benchmark. Keeps CLI11, which compiles slowly, out of the benchmarks.
/// add() binds an option to a variable. The initial value of the variable is the default of the option. The variable
/// must outlive the object. A list is written with commas: "1,2". Names have CLI11's syntax: "--runs", "-o,--output".
class Program {
 public:
  Program(const std::string& name, const std::string& summary);
  ~Program();

  void addMeshes(std::vector<std::string>& paths);  ///< One or more meshes.
  /// Zero or more meshes; `substitute` is the text of --help that describes the default mesh.
  void addOptionalMeshes(std::vector<std::string>& paths, const std::string& substitute);

  void add(const std::string& name, bool& value, const std::string& text);
  void add(const std::string& name, std::string& value, const std::string& text);
  void addRequired(const std::string& name, std::string& value, const std::string& placeholder,
                   const std::string& text);
  void add(const std::string& name, uint32_t& value, const std::string& text, Range<uint32_t> range = {});
  void add(const std::string& name, uint64_t& value, const std::string& text, Range<uint64_t> range = {});
  void add(const std::string& name, double& value, const std::string& text, Range<double> range = {});

  void add(const std::string& name, std::vector<std::string>& list, const std::string& text, char separator = ',');
  void add(const std::string& name, std::vector<uint32_t>& list, const std::string& text, Range<uint32_t> range = {});
  void add(const std::string& name, std::vector<uint64_t>& list, const std::string& text);
  void add(const std::string& name, std::vector<double>& list, const std::string& text);

  /// Parses the command line, runs `body` and prints an exception to standard error. SIGINT and SIGTERM request a stop,
  /// so that temporary files are removed. A second signal ends the process. Returns the exit code: 0 done, 1 usage, 2
  /// input, 3 device, 4 output, 70 other failures, 130 cancelled.
  [[nodiscard]] int run(int argc, char** argv, const std::function<void(const RunControl&)>& body);

 private:
  std::unique_ptr<CLI::App> app_;
};

/// Writes to standard output. Throws Error{Output} with the reason.
void writeOutput(std::string_view text);

/// Writes a line to standard error; failures are ignored.
void writeProgress(std::string_view text);

}  // namespace asdfvk::bench
