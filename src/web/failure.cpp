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
    std::string message = messageWithRemedy(error);
    if (error.code() == ErrorCode::InputTooLarge) message += "; " + memoryRemedy();
    return {nameOf(error.code()), oneLine(message)};
  } catch (const std::bad_alloc&) {
    return {nameOf(ErrorCode::InputTooLarge), "not enough memory for this mesh; " + memoryRemedy()};
  } catch (const std::exception& error) {
    return {"internal", oneLine(fmt::format("internal error: {}; please report it", error.what()))};
  } catch (...) {
    return {"internal", "internal error; please report it"};
  }
}

}  // namespace asdfvk
