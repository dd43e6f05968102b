#include "cli/options_hash.h"

#include "batch/content_hash.h"
#include "core/json.h"

namespace asdfvk {
namespace {

/// The values of the report, exact numbers where it rounds, and what it does not have.
Json identityOf(const Computation& computation, const SessionOptions& session, const Outputs& outputs) {
  const Options& options = computation.options;
  return {{"options", optionValues(computation, session)},
          {"seeds", {static_cast<int>(options.seeds.kind), options.seeds.share, options.seeds.count}},
          {"fields", fieldNames(outputs, options)},
          {"choosesFields", !outputs.fields.empty()},
          {"computesCentres", options.computesCentres},
          {"format", outputs.format},
          {"ascii", outputs.ascii},
          {"check", options.checkCount ? Json(*options.checkCount) : Json(nullptr)},
          {"rngSeed", options.randomSeed},
          {"estimatesError", options.estimatesError},
          {"against", computation.against}};
}

}  // namespace

std::string optionsHash(const Computation& computation, const std::optional<Computation>& compared,
                        const SessionOptions& session, const Outputs& outputs) {
  Json identity = Json::array({identityOf(computation, session, outputs)});
  if (compared) identity.push_back(identityOf(*compared, session, outputs));
  return contentHash(identity.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace asdfvk
