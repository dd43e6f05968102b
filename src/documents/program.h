#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "arguments/arguments.h"

/// A program as its man page and its completions for bash show it. Everything about options is read from the
/// ArgumentParser that also parses the command line.
namespace asdfvk {

/// Values of an option or argument.
struct Values {
  std::string placeholder;   ///< The same text as in the help: "N%|N|all", "FILE.ply", "[=N|all]"; empty for a flag.
  uint32_t count = 0;        ///< 0 for a flag.
  bool areAttached = false;  ///< Optional, and given as --name=value only.
  bool areList = false;      ///< Words separated by commas.
  bool areFiles = false;     ///< A file is among the values.
  std::vector<std::string> words;       ///< Literal values: "paper", "balanced".
  std::vector<std::string> extensions;  ///< Extensions of the files, without the dot; empty: any.
};

/// Values from a placeholder. An alternative (between bars) in lower case is a literal value; FILE is any file,
/// FILE.ply one of that extension; ",..." at the end marks a list.
[[nodiscard]] Values parseValues(const std::string& placeholder);

/// The text is one line.
struct DocumentedOption : ArgumentDescription {
  Values values;
};

/// All text is plain: no markup.
struct Program {
  std::string name;  ///< The words that call it: "asdf-vk summarize" has the man page asdf-vk-summarize.
  std::string version;
  std::string summary;  ///< For whatis and apropos: no capital, no full stop.
  std::string description;
  std::vector<DocumentedOption> arguments, options;  ///< In the order of the help.
  std::vector<std::pair<int, std::string>> exitCodes;
  std::string exitNote;
  std::vector<std::pair<std::string, std::string>> files, environment;  ///< Name and meaning.
  std::vector<std::pair<std::string, std::string>> examples;            ///< What it does, command.
  std::vector<std::string> seeAlso;                                     ///< Other man pages: "man(1)".
};

/// Name, description, arguments and options of `parser`. Throws CheckFailure where an option has no name that starts
/// with two dashes.
[[nodiscard]] Program describe(const ArgumentParser& parser);

/// asdf-vk and asdf-vk-generate.
[[nodiscard]] std::vector<Program> documentedPrograms();

/// `asdf-vk summarize`, for a man page named asdf-vk-summarize.
[[nodiscard]] Program documentedSummarize();

/// docs/options.md with the rows of the options between "<!-- options of GROUP -->" and "<!-- end -->".
[[nodiscard]] std::string optionPage(std::string page);
/// python/asdf_vk/_keywords.py
[[nodiscard]] std::string keywordModule();

[[nodiscard]] std::string manPage(const Program& program);
[[nodiscard]] std::string bashCompletion(const Program& program);

}  // namespace asdfvk
