#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "core/text.h"
#include "documents/program.h"

namespace asdfvk {
namespace {

/// "ply" as [pP][lL][yY], a pattern of any case.
std::string anyCase(const std::string& extension) {
  std::string pattern;
  for (const unsigned char c : extension)
    pattern +=
        std::isalpha(c) ? fmt::format("[{}{}]", char(std::tolower(c)), char(std::toupper(c))) : std::string(1, c);
  return pattern;
}

std::string patternsOf(const Values& values) {
  std::string patterns;
  for (const std::string& extension : values.extensions) patterns += fmt::format(" '!*.{}'", anyCase(extension));
  return patterns;
}

/// The commands that complete a value of `current`.
std::string reply(const Values& values, const std::string& function) {
  const std::string words = joined(values.words, " ");
  if (values.areFiles) return fmt::format("{}_files{}", function, patternsOf(values));
  if (values.areList) return fmt::format("{}_list '{}'", function, words);
  return fmt::format("{}_words '{}'", function, words);
}

/// The functions that fill COMPREPLY. With -o default readline completes other files where none fits; +o turns it off.
constexpr const char* kFunctions = R"(
{0}_words() {{
  compopt +o default 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "$1" -- "$current")
}}

{0}_list() {{
  local before=
  [[ $current == *,* ]] && before=${{current%,*}},
  compopt +o default -o nospace 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -P "$prefix$before" -W "$1" -- "${{current##*,}}")
}}

{0}_files() {{
  local pattern
  compopt -o filenames 2>/dev/null
  if (($# == 0)); then
    mapfile -t COMPREPLY < <(compgen -P "$prefix" -f -- "$current")
    return
  fi
  mapfile -t COMPREPLY < <(
    compgen -P "$prefix" -d -- "$current"
    for pattern; do compgen -P "$prefix" -f -X "$pattern" -- "$current"; done
  )
}}
)";

constexpr const char* kBegin = R"(
{0}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} option='' prefix='' word
  COMPREPLY=()
  # Bash splits --name=value into three words, unless = is not in COMP_WORDBREAKS.
  if [[ $current == --*=* ]]; then
    option=${{current%%=*}}=
    prefix=$option
    current=${{current#*=}}
  elif [[ $current == = ]]; then
    option=${{COMP_WORDS[COMP_CWORD - 1]}}=
    current=
  elif ((COMP_CWORD >= 2)) && [[ ${{COMP_WORDS[COMP_CWORD - 1]}} == = ]]; then
    option=${{COMP_WORDS[COMP_CWORD - 2]}}=
  elif ((COMP_CWORD >= 1)); then
    option=${{COMP_WORDS[COMP_CWORD - 1]}}
  fi
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD - 1}}"; do
    [[ $word == -- ]] && option=--
  done
  case $option in
)";

constexpr const char* kEnd = R"(    *)
      if [[ $current == -* && $option != -- ]]; then
        {0}_words '{1}'
      else
        {2}
      fi
      ;;
  esac
}}

complete -o default -F {0} {3}
)";

std::string caseOf(const DocumentedOption& option, const std::string& function) {
  if (option.values.count == 0) return "";
  std::string names;
  for (const std::string& name : option.names) {
    if (!option.values.areAttached) names += (names.empty() ? "" : " | ") + name;
    if (name.starts_with("--")) names += (names.empty() ? "" : " | ") + name + "=";
  }
  return fmt::format("    {}) {} ;;\n", names, reply(option.values, function));
}

}  // namespace

std::string bashCompletion(const Program& program) {
  std::string function = "_" + program.name;
  std::replace(function.begin(), function.end(), '-', '_');
  std::string text =
      fmt::format("# Completions of {} for bash. Generated from the options of the program.\n", program.name);
  text += fmt::format(kFunctions, function) + fmt::format(kBegin, function);
  std::vector<std::string> names;
  for (const DocumentedOption& option : program.options) {
    text += caseOf(option, function);
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return text + fmt::format(kEnd, function, joined(names, " "), reply(program.arguments.front().values, function),
                            program.name);
}

}  // namespace asdfvk
