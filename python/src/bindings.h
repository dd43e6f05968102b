#pragma once

#include <pybind11/pybind11.h>

namespace asdfvk::python {

void bindFiles(pybind11::module_& module);

/// Adds write_picture(path, mesh, fields, name) and write_page(path, mesh, layers). name: name of the field; empty: the
/// first field. layers: pairs of fields and of texts with the keys name, label, summary, error_sentence, warnings,
/// defects.
void bindShown(pybind11::module_& module);

void bindScenes(pybind11::module_& module);

/// Adds the functions of asdf_vk/cgal.h: postprocess_sdf(mesh, values, threads, progress) -> (normalized, min, max) and
/// segment_sdf(mesh, values, options, returns_clusters, threads, progress) -> (labels, count). mesh: see viewOf();
/// values: double; options: clusters, smoothness and expansion as in optionsOf(); threads: see ThreadLimit.
void bindCgal(pybind11::module_& module);

}  // namespace asdfvk::python
