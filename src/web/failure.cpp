#include "web/failure.h"

#include <fmt/core.h>

#include <exception>
#include <new>

#include "asdf_vk/error.h"
#include "core/text.h"
#include "describe/remedies.h"
#include "web/mesh_limit.h"

namespace asdfvk {

PageFailure currentPageFailure() {
  try {
    throw;
  } catch (const Error& error) {
    return {nameOf(error.code()), oneLine(messageWithRemedy(error))};
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
