#pragma once

#include <cstddef>

#include "io/threemf_model_list.h"
#include "io/xml_reader.h"

namespace asdfvk {

/// Reads the model `index`, and adds the models that it names to the list. The settings of its objects are removed from
/// models.settings(). Throws Error as failInput() does.
void readModel(XmlReader& xml, ModelList& models, size_t index);

}  // namespace asdfvk
