#include "arguments/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

namespace asdfvk {
namespace {

/// An option whose value is converted into `target` by CLI11.
template <typename T>
Argument addConverted(CLI::App& app, std::string_view name, std::string_view placeholder, std::string_view text,
                      T& target) {
  return Argument(app.add_option(std::string(name), target, std::string(text))->option_text(std::string(placeholder)));
}

ArgumentDescription describeOption(const CLI::Option& option) {
  ArgumentDescription result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  result.placeholder = option.get_option_text();
  result.completions = option.get_type_name();
  result.valueCount = option.get_positional() ? 1 : static_cast<uint32_t>(option.get_items_expected_max());
  result.text = option.get_description();
  result.group = option.get_group();
  for (const CLI::Option* needed : option.get_needs()) result.needs.push_back(needed->get_name());
  result.isRequired = option.get_required();
  return result;
}

}  // namespace

Argument Argument::group(std::string_view heading) const {
  option_->group(std::string(heading));
  return *this;
}

Argument Argument::needs(Argument other) const {
  option_->needs(other.option_);
  return *this;
}

Argument Argument::require() const {
  option_->required();
  return *this;
}

Argument Argument::completions(std::string_view values) const {
  option_->type_name(std::string(values));
  return *this;
}

ArgumentParser::ArgumentParser() : app_(std::make_unique<CLI::App>()) {}

ArgumentParser::~ArgumentParser() = default;

void ArgumentParser::setProgram(std::string_view name, std::string_view description) {
  app_->name(std::string(name));
  app_->description(std::string(description));
}

void ArgumentParser::setFooter(std::string_view footer) { app_->footer(std::string(footer)); }

void ArgumentParser::setHelp(std::string_view text) { app_->set_help_flag("-h,--help", std::string(text)); }

void ArgumentParser::addVersion(std::string_view version) {
  app_->set_version_flag("--version", std::string(version), "Print the version");
}

Argument ArgumentParser::addValue(std::string_view name, std::string_view placeholder, std::string_view text,
                                  const std::function<void(const std::string&)>& receive) {
  return Argument(app_->add_option_function<std::string>(std::string(name), receive, std::string(text))
                      ->option_text(std::string(placeholder)));
}

Argument ArgumentParser::addNumber(std::string_view name, std::string_view placeholder, std::string_view text,
                                   uint64_t& target) {
  return addConverted(*app_, name, placeholder, text, target);
}

Argument ArgumentParser::addNumber(std::string_view name, std::string_view placeholder, std::string_view text,
                                   double& target) {
  return addConverted(*app_, name, placeholder, text, target);
}

Argument ArgumentParser::addNumbers(std::string_view name, std::string_view placeholder, std::string_view text,
                                    std::array<double, 3>& target) {
  return addConverted(*app_, name, placeholder, text, target);
}

Argument ArgumentParser::addList(std::string_view name, std::string_view placeholder, std::string_view text,
                                 std::vector<std::string>& target) {
  return addConverted(*app_, name, placeholder, text, target);
}

Argument ArgumentParser::addFlag(std::string_view name, bool& target, std::string_view text) {
  return Argument(app_->add_flag(std::string(name), target, std::string(text)));
}

Argument ArgumentParser::addFlag(std::string_view name, std::function<void()> receive, std::string_view text) {
  return Argument(app_->add_flag_callback(std::string(name), std::move(receive), std::string(text)));
}

ParseResult ArgumentParser::parse(std::vector<std::string> arguments) {
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back.
  ParseResult result;
  try {
    app_->parse(std::move(arguments));
  } catch (const CLI::CallForVersion& version) {
    result.answer = std::string(version.what()) + "\n";
  } catch (const CLI::Success&) {
    result.answer = help();
  } catch (const CLI::ArgumentMismatch& error) {
    result.refusal = error.what();
    result.miscounted = result.refusal.substr(0, result.refusal.find(':'));
  } catch (const CLI::ParseError& error) {
    result.refusal = error.what();
  }
  return result;
}

bool ArgumentParser::isGiven(const std::string& name) const { return app_->count(name) > 0; }

std::vector<std::string> ArgumentParser::givenNames() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : std::as_const(*app_).get_options())
    if (option->count() > 0) names.push_back(option->get_name());
  return names;
}

void ArgumentParser::setHelpGroup(std::string_view group) { helpGroup_ = group; }

std::string ArgumentParser::help() {
  // The options are hidden here and not before parse(): CLI11 omits the names of hidden options in its messages.
  for (CLI::Option* option : app_->get_options())
    if (!helpGroup_.empty() && option->get_group() != helpGroup_ && !option->get_positional()) option->group("");
  return app_->help();
}

std::string ArgumentParser::name() const { return app_->get_name(); }

std::string ArgumentParser::description() const { return app_->get_description(); }

std::vector<ArgumentDescription> ArgumentParser::describe() const {
  std::vector<ArgumentDescription> result;
  for (const CLI::Option* option : std::as_const(*app_).get_options()) result.push_back(describeOption(*option));
  const std::vector<std::string> groups = app_->get_groups();
  const auto rank = [&](const ArgumentDescription& argument) {
    return argument.names.empty() ? -1 : std::find(groups.begin(), groups.end(), argument.group) - groups.begin();
  };
  std::stable_sort(result.begin(), result.end(),
                   [&](const ArgumentDescription& a, const ArgumentDescription& b) { return rank(a) < rank(b); });
  return result;
}

}  // namespace asdfvk
