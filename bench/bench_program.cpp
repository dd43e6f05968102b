#include "bench_program.h"

#include <CLI/CLI.hpp>

#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"

namespace asdfvk::bench {
namespace {

// --help tells of limits only where there are some.
template <typename T>
void limit(CLI::Option& option, const Allowed<T>& allowed) {
  if (allowed != Allowed<T>{}) option.check(CLI::Range(allowed.least, allowed.most));
}

template <typename T>
void addNumber(CLI::App& app, const std::string& name, T& value, const std::string& text, const Allowed<T>& allowed) {
  limit(*app.add_option(name, value, text)->capture_default_str(), allowed);
}

// Without the limit to one argument a list would take the meshes behind it, too.
template <typename T>
CLI::Option* addList(CLI::App& app, const std::string& name, std::vector<T>& list, const std::string& text,
                     char separator = ',') {
  return app.add_option(name, list, text)->delimiter(separator)->allow_extra_args(false)->capture_default_str();
}

}  // namespace

BenchProgram::BenchProgram(const std::string& name, const std::string& summary)
    : app_(std::make_unique<CLI::App>(summary, name)) {}

BenchProgram::~BenchProgram() = default;

void BenchProgram::addMeshes(std::vector<std::string>& paths) {
  app_->add_option("meshes", paths, "Meshes")->option_text("MESH...")->required();
}

void BenchProgram::addMeshesOr(std::vector<std::string>& paths, const std::string& whatIsUsedWithoutAny) {
  app_->add_option("meshes", paths, "Meshes; without one " + whatIsUsedWithoutAny)->option_text("MESH...");
}

void BenchProgram::add(const std::string& name, bool& value, const std::string& text) {
  app_->add_flag(name, value, text);
}

void BenchProgram::addHidden(const std::string& name, bool& value) { app_->add_flag(name, value)->group(""); }

void BenchProgram::add(const std::string& name, std::string& value, const std::string& text) {
  app_->add_option(name, value, text)->capture_default_str();
}

void BenchProgram::addRequired(const std::string& name, std::string& value, const std::string& placeholder,
                               const std::string& text) {
  app_->add_option(name, value, text)->option_text(placeholder)->required();
}

void BenchProgram::addChoice(const std::string& name, std::string& value, const std::vector<std::string>& choices,
                             const std::string& text) {
  app_->add_option(name, value, text)->check(CLI::IsMember(choices))->option_text(CLI::detail::join(choices, "|"));
}

void BenchProgram::add(const std::string& name, uint32_t& value, const std::string& text, Allowed<uint32_t> allowed) {
  addNumber(*app_, name, value, text, allowed);
}

void BenchProgram::add(const std::string& name, uint64_t& value, const std::string& text, Allowed<uint64_t> allowed) {
  addNumber(*app_, name, value, text, allowed);
}

void BenchProgram::add(const std::string& name, double& value, const std::string& text, Allowed<double> allowed) {
  addNumber(*app_, name, value, text, allowed);
}

void BenchProgram::add(const std::string& name, std::vector<std::string>& list, const std::string& text,
                       char separator) {
  addList(*app_, name, list, text, separator);
}

void BenchProgram::add(const std::string& name, std::vector<uint32_t>& list, const std::string& text,
                       Allowed<uint32_t> allowed) {
  limit(*addList(*app_, name, list, text), allowed);
}

void BenchProgram::add(const std::string& name, std::vector<uint64_t>& list, const std::string& text) {
  addList(*app_, name, list, text);
}

void BenchProgram::add(const std::string& name, std::vector<double>& list, const std::string& text) {
  addList(*app_, name, list, text);
}

int BenchProgram::run(int argc, char** argv, const std::function<void(const RunControl&)>& body) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) == 0 ? 0 : static_cast<int>(ExitCode::Usage);
  }
  try {
    const Interrupt interrupt;
    const Interrupt::Listening listening;
    body({interrupt.token(), {}});
    return 0;
  } catch (...) {
    const Failure failure = currentFailure();
    printError(app_->get_name(), failure.message);
    return static_cast<int>(failure.code);
  }
}

}  // namespace asdfvk::bench
