#include "cli/options_hash.h"

#include "batch/content_hash.h"
#include "core/json.h"

namespace asdfvk {
namespace {

/// The values of the report, exact numbers where it rounds, and what it does not have.
Json identityOf(const CommandLine& line) {
  const Options& options = line.options;
  Json compared = Json::array();
  for (const CommandLine& other : line.compared) compared.push_back(identityOf(other));
  return {{"options", optionValues(line)},
          {"seeds", {static_cast<int>(options.seeds.kind), options.seeds.share, options.seeds.count}},
          {"fields", line.fields},
          {"choosesFields", line.choosesFields},
          {"computesCentres", options.computesCentres},
          {"format", line.format},
          {"ascii", line.ascii},
          {"check", options.checkCount ? Json(*options.checkCount) : Json(nullptr)},
          {"rngSeed", options.randomSeed},
          {"estimatesError", options.estimatesError},
          {"against", line.against},
          {"compared", compared}};
}

}  // namespace

std::string optionsHash(const CommandLine& line) {
  return contentHash(identityOf(line).dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace asdfvk
