#pragma once

#include <filesystem>

#include "asdf_vk/run_control.h"
#include "asdf_vk/session.h"
#include "page/page.h"

namespace asdfvk {

class AtomicFiles;
struct View;

/// Adds a result with its thin places, segments, view and a small picture. texts: name, label and report. fields: the
/// fields to show, beginning with the field of the picture. Preconditions: the result has a scene; there is a field.
/// Throws Error{Cancelled}.
void addResult(Page& page, PageTexts texts, const Result& result, FieldSpan fields, const View& view,
               const RunControl& control);

/// A page without results, with the name and version of this program as generator.
[[nodiscard]] Page emptyPage();

/// Writes the page atomically. Throws Error{OutputNotWritable}.
void writePage(const std::filesystem::path& path, const Page& page);
/// The file appears when the caller commits the group.
void writePage(AtomicFiles& files, const std::filesystem::path& path, const Page& page);

}  // namespace asdfvk
