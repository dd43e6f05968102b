#pragma once

#include <string>
#include <utility>
#include <vector>

#include "documents/report_model.h"

/// The texts that follow from the rows of options, the report and its fields. asdfvk-write-documents writes them.
namespace asdfvk {

/// Returns a page of docs/man in which the marks (@VERSION@, ...) are replaced. help: the text of
/// ArgumentParser::help().
[[nodiscard]] std::string manPage(const std::string& page, const std::string& version, const std::string& help,
                                  const std::vector<std::pair<int, std::string>>& exitCodes);

/// Returns docs/options.md with new rows of options between "<!-- options of GROUP -->" and "<!-- end -->".
[[nodiscard]] std::string optionPage(std::string page);

/// Returns docs/formats.md with new tables of the fields and of the keys of the report.
[[nodiscard]] std::string formatPage(const std::string& page, const ReportModel& model);

/// docs/schema.json. model: documentModel(). earlier: the text of an earlier version, from which the versions of keys
/// are taken. Throws Error{ValueOutOfRange} if a key of a released version is missing or has another type, and
/// kJsonFormatVersion is the same.
[[nodiscard]] std::string jsonSchema(const ReportModel& model, const std::string& earlier);

/// The module asdf_vk._keywords.
[[nodiscard]] std::string keywordModule();
/// The module asdf_vk._report.
[[nodiscard]] std::string reportModule(const ReportModel& model);

}  // namespace asdfvk
