#pragma once

/// Local thickness of triangle meshes, computed by Vulkan or on the CPU. This header includes the whole C++ interface
/// except openmesh.h, which needs OpenMesh.
///
///   asdfvk::Session session;                              // opens the device once
///   asdfvk::Mesh mesh = asdfvk::readMesh("horse.ply");    // or a MeshView of your own arrays
///   asdfvk::Result result = session.compute(mesh);        // result.sdf()[face], in the unit of the mesh
///   asdfvk::writeResult("horse.vtu", mesh, result.fields);
///
/// The included headers need the standard library only.
#include "asdf_vk/cgal.h"              // IWYU pragma: export
#include "asdf_vk/choices.h"           // IWYU pragma: export
#include "asdf_vk/error.h"             // IWYU pragma: export
#include "asdf_vk/field.h"             // IWYU pragma: export
#include "asdf_vk/files.h"             // IWYU pragma: export
#include "asdf_vk/finding.h"           // IWYU pragma: export
#include "asdf_vk/mesh.h"              // IWYU pragma: export
#include "asdf_vk/options.h"           // IWYU pragma: export
#include "asdf_vk/report.h"            // IWYU pragma: export
#include "asdf_vk/run_control.h"       // IWYU pragma: export
#include "asdf_vk/scene.h"             // IWYU pragma: export
#include "asdf_vk/session.h"           // IWYU pragma: export
#include "asdf_vk/thickness_report.h"  // IWYU pragma: export
#include "asdf_vk/version.h"           // IWYU pragma: export
