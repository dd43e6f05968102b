#pragma once

#include <filesystem>
#include <vector>

#include "asdf_vk/run_control.h"
#include "asdf_vk/session.h"
#include "page/page.h"

namespace asdfvk {

class AtomicFiles;
struct View;

/// Adds a result with its thin places, segments and view. texts: name, label, report and picture. fields: the fields to
/// show. Preconditions: the result has a scene; there is a field.
void addResult(Page& page, PageTexts texts, const Result& result, FieldSpan fields, const View& view);

/// PageTexts::picture: the thin places, else the first of the fields. Preconditions as for addResult(). Throws
/// Error{Cancelled}.
[[nodiscard]] std::vector<char> fallbackPicture(const Result& result, FieldSpan fields, const View& view,
                                                const RunControl& control);

/// A page without results, with the name and version of this program as generator.
[[nodiscard]] Page emptyPage();

/// Writes the page atomically. Throws Error{OutputNotWritable}.
void writePage(const std::filesystem::path& path, const Page& page);
/// The file appears when the caller commits the group.
void writePage(AtomicFiles& files, const std::filesystem::path& path, const Page& page);

}  // namespace asdfvk
