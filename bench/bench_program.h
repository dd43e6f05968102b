#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "asdf_vk/run_control.h"

namespace CLI {
class App;
}

namespace asdfvk::bench {

/// What an option may be set to, both ends included.
template <typename T>
struct Allowed {
  T least = std::numeric_limits<T>::lowest(), most = std::numeric_limits<T>::max();

  friend bool operator==(const Allowed&, const Allowed&) = default;
};

/// The command line of a benchmark, and what each does alike around its work. Hides CLI11, which takes long to compile.
/// An option writes to its `value`, which must outlive this and whose first content is its default; a list is written
/// with commas, "1,2". Names are as CLI11 takes them: "--runs", "-o,--output".
class BenchProgram {
 public:
  /// `name` as people start it, `summary` what it does, for --help.
  BenchProgram(const std::string& name, const std::string& summary);
  ~BenchProgram();

  void addMeshes(std::vector<std::string>& paths);  ///< One at least.
  void addMeshesOr(std::vector<std::string>& paths, const std::string& whatIsUsedWithoutAny);

  void add(const std::string& name, bool& value, const std::string& text);  ///< False, until the option is given.
  void addHidden(const std::string& name, bool& value);
  void add(const std::string& name, std::string& value, const std::string& text);
  void addRequired(const std::string& name, std::string& value, const std::string& placeholder,
                   const std::string& text);
  void addChoice(const std::string& name, std::string& value, const std::vector<std::string>& choices,
                 const std::string& text);
  void add(const std::string& name, uint32_t& value, const std::string& text, Allowed<uint32_t> allowed = {});
  void add(const std::string& name, uint64_t& value, const std::string& text, Allowed<uint64_t> allowed = {});
  void add(const std::string& name, double& value, const std::string& text, Allowed<double> allowed = {});

  void add(const std::string& name, std::vector<std::string>& list, const std::string& text, char separator = ',');
  void add(const std::string& name, std::vector<uint32_t>& list, const std::string& text,
           Allowed<uint32_t> allowed = {});
  void add(const std::string& name, std::vector<uint64_t>& list, const std::string& text);
  void add(const std::string& name, std::vector<double>& list, const std::string& text);

  /// Parses, runs `body`, and tells what it throws on standard error. Ctrl-C asks `body` to stop, so that its temporary
  /// files are removed. Returns the exit code, as asdf-vk's are.
  [[nodiscard]] int run(int argc, char** argv, const std::function<void(const RunControl&)>& body);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace asdfvk::bench
