#include "web/failure.h"

#include <fmt/core.h>

#include <exception>
#include <new>
#include <string_view>
#include <utility>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "web/mesh_limit.h"

namespace asdfvk {
namespace {

/// Remedies in a page, which has no options of the command line.
constexpr std::pair<ErrorCode, std::string_view> kPageRemedies[]{
    {ErrorCode::NoValues, "the faces may be turned inside out; export the mesh again with outward faces"},
    {ErrorCode::MeshTooLarge, "split the mesh"},
    {ErrorCode::TooManyFaces, "the program asdf-vk has the option --max-faces"},
};

}  // namespace

PageFailure currentPageFailure() {
  try {
    throw;
  } catch (const Error& error) {
    std::string message = error.what();
    for (const auto& [code, remedy] : kPageRemedies)
      if (code == error.code()) message += fmt::format("; {}", remedy);
    return {nameOf(error.code()), oneLine(message)};
  } catch (const std::bad_alloc&) {
    return {
        nameOf(ErrorCode::InputTooLarge),
        fmt::format("not enough memory for this mesh; meshes of at most {} usually fit; use the program asdf-vk, or "
                    "a coarser mesh",
                    counted(kMaxPageTriangleCount, "triangle"))};
  } catch (const std::exception& error) {
    return {"internal", oneLine(fmt::format("internal error: {}; please report it", error.what()))};
  } catch (...) {
    return {"internal", "internal error; please report it"};
  }
}

}  // namespace asdfvk
