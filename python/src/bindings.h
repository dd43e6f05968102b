#pragma once

#include <pybind11/pybind11.h>

namespace asdfvk::python {

void bindFiles(pybind11::module_& module);

/// Adds ShownReport(computed_fields), write_picture(path, mesh, fields, name, report) and write_page(path, mesh, name,
/// layers). In write_picture(), `name` is the name of a field; empty: see shownField(). In write_page(), `name` is the
/// name of the mesh. layers: tuples of fields, label and report. report: a ShownReport or None.
void bindShown(pybind11::module_& module);

void bindScenes(pybind11::module_& module);

/// Adds the functions of asdf_vk/cgal.h: postprocess_sdf(mesh, values, threads, progress) -> (normalized, min, max) and
/// segment_sdf(mesh, values, options, returns_clusters, threads, progress) -> (labels, count). mesh: see viewOf();
/// values: double; options: clusters, smoothness and expansion as in optionsOf(); threads: see ThreadLimit.
void bindCgal(pybind11::module_& module);

}  // namespace asdfvk::python
