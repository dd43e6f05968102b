// Entry points of the WebAssembly module, for src/web/browser/worker.js. Files are in the file system of Emscripten.

#include <emscripten.h>

#include <cstdint>
#include <new>
#include <optional>
#include <string>

#include "core/json.h"
#include "web/failure.h"
#include "web/page_session.h"

namespace asdfvk {
namespace {

EM_JS(void, reportProgress, (double fraction), { Module.onProgress(fraction); });

struct Module {
  PageSession session;
  std::optional<Page> page;  ///< The page of the last answer, for its arrays.
  std::string answer;
};

Module& module() {
  static Module module;
  return module;
}

/// The JSON of work(control), or of a failure. Valid until the next call.
template <typename Work>
const char* answerOf(const Work& work) {
  Json json;
  try {
    RunControl control;
    control.progress = [](double fraction) { reportProgress(fraction); };
    json["result"] = work(control);
  } catch (...) {
    const PageFailure failure = currentPageFailure();
    json = {{"error", {{"code", failure.code}, {"message", failure.message}}}};
  }
  module().answer = jsonText(json);
  return module().answer.c_str();
}

Json results() {
  Module& all = module();
  all.page.emplace(all.session.page());
  return {
      {"report", all.session.report()}, {"data", all.page->data()}, {"arrayCount", all.page->arrays().all().size()}};
}

}  // namespace
}  // namespace asdfvk

using namespace asdfvk;  // NOLINT: the functions of C have no namespace.

extern "C" {

/// unit: null: the unit that the file states.
EMSCRIPTEN_KEEPALIVE const char* openMesh(const char* name, const char* unit) {
  return answerOf([&](const RunControl& control) {
    module().page.reset();
    return module().session.open(name, unit == nullptr ? std::nullopt : std::optional<std::string>(unit), control);
  });
}

EMSCRIPTEN_KEEPALIVE const char* checkMesh(const char* options) {
  return answerOf([&](const RunControl& control) {
    module().session.check(Json::parse(options), control);
    return results();
  });
}

EMSCRIPTEN_KEEPALIVE const char* computeMesh(const char* options) {
  return answerOf([&](const RunControl& control) {
    module().session.compute(Json::parse(options), control);
    return results();
  });
}

EMSCRIPTEN_KEEPALIVE const char* saveResult(const char* name) {
  return answerOf([&](const RunControl&) {
    module().session.save(name);
    return Json();
  });
}

/// Arrays of the page of the last check or computation.
EMSCRIPTEN_KEEPALIVE const uint8_t* arrayBytes(uint32_t number) { return module().page->arrays().all()[number].data(); }
EMSCRIPTEN_KEEPALIVE uint32_t arraySize(uint32_t number) {
  return static_cast<uint32_t>(module().page->arrays().all()[number].size());
}

}  // extern "C"
