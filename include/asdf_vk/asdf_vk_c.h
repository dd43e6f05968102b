/* Local thickness of triangle meshes: the interface in C99, for C, C#, Rust, Julia and others (docs/c.md).
 *
 * Functions return a status; after a failure asdf_vk_last_error() returns the reason. A handle that is null, of another
 * type or destroyed is an error, not a crash. Any thread may use a handle. Computations on the scenes of one session
 * run one after another. Precondition: no thread sets an option while another thread uses the same asdf_vk_options. No
 * C++ exception leaves a function. A function computes in the default floating-point environment (rounding, traps,
 * flushing of denormals) on all its threads. On return, the function restores the caller's environment, status flags
 * included. In a process that was forked after the first call, every call fails.
 *
 * The library does not keep pointers to the caller's arrays and texts after a call. Texts are UTF-8 and end with a zero
 * byte. A pointer that a function returns belongs to the object in its first argument and is valid until that object is
 * destroyed. Objects may be destroyed in any order: a scene keeps its session alive, and a result keeps its mesh. The
 * functions asdf_vk_..._destroy() ignore null and destroyed handles, and do not wait for a computation. A function that
 * fails leaves its outputs unchanged. */
#ifndef ASDF_VK_C_H
#define ASDF_VK_C_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define ASDF_VK_C_API __attribute__((visibility("default")))
#else
#define ASDF_VK_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(readability-identifier-naming) */

/* Version of the binary interface and of the shared library (libasdf-vk-c.so.1). The loaded library fits this header
 * if asdf_vk_abi() returns ASDF_VK_ABI. Releases with an equal ASDF_VK_ABI differ only
 * in added functions and enumerators. */
#define ASDF_VK_ABI 1
ASDF_VK_C_API int asdf_vk_abi(void);
/* Version of asdf-vk as a text: "0.2.0". */
ASDF_VK_C_API const char* asdf_vk_version(void);
/* Version of asdf-vk as a number: 10000 major + 100 minor + patch. */
ASDF_VK_C_API int asdf_vk_version_number(void);

/* The values equal the exit codes of the program asdf-vk. */
typedef enum asdf_vk_status {
  ASDF_VK_OK = 0,
  ASDF_VK_USAGE =
      1, /* A null argument or an invalid handle; an unknown or contradictory option, or a value out of range. */
  ASDF_VK_INPUT = 2,      /* A mesh or array is unreadable, invalid or too large, or no value can be computed. */
  ASDF_VK_DEVICE = 3,     /* No device is usable, or the device was lost or is too small. */
  ASDF_VK_OUTPUT = 4,     /* A file cannot be written. */
  ASDF_VK_INTERNAL = 70,  /* A defect of the library, or a limit of the operating system. */
  ASDF_VK_CANCELLED = 130 /* The progress function requested a stop. */
} asdf_vk_status;

/* Reason of the last failure in the calling thread, in one line; "" before the first failure. The text is valid until
 * the next failure in this thread. */
ASDF_VK_C_API const char* asdf_vk_last_error(void);
/* Code of the last failure in the calling thread: "deviceLost" for ErrorCode::DeviceLost of asdf_vk/error.h, "internal"
 * for a failure without an ErrorCode, "" before the first failure. */
ASDF_VK_C_API const char* asdf_vk_last_error_name(void);

typedef enum asdf_vk_type {
  ASDF_VK_FLOAT64 = 0,
  ASDF_VK_FLOAT32 = 1,
  ASDF_VK_UINT8 = 2,
  ASDF_VK_UINT32 = 3,
  ASDF_VK_INT32 = 4
} asdf_vk_type;

typedef enum asdf_vk_location { ASDF_VK_PER_FACE = 0, ASDF_VK_PER_VERTEX = 1 } asdf_vk_location;

typedef struct asdf_vk_options asdf_vk_options; /* Option names and their values. */
typedef struct asdf_vk_session asdf_vk_session; /* A device with its pipelines, for many meshes. */
typedef struct asdf_vk_scene asdf_vk_scene;     /* A mesh of a session, for many computations. */
typedef struct asdf_vk_result asdf_vk_result;   /* The fields and the report of a computation. */

ASDF_VK_C_API asdf_vk_status asdf_vk_options_create(asdf_vk_options** options);
/* Sets an option by name and value, for example ("seeds", "10%") or ("thinner-than", "0.8mm"). name: as in
 * docs/options.md, without the leading dashes. value: a text as on the command line, or "on" or "off" for a flag;
 * null restores the default. The functions that take the options report contradictory options. */
ASDF_VK_C_API asdf_vk_status asdf_vk_options_set(asdf_vk_options* options, const char* name, const char* value);
ASDF_VK_C_API void asdf_vk_options_destroy(asdf_vk_options* options);

/* Opens the device. options: may hold "backend", "device", "require-gpu" and "threads" only; null: the defaults. */
ASDF_VK_C_API asdf_vk_status asdf_vk_session_create(const asdf_vk_options* options, asdf_vk_session** session);
/* text: the first line has the chosen device and the reason. Each further line has a device that was not chosen. The
 * text describes the devices at the creation of the session. */
ASDF_VK_C_API asdf_vk_status asdf_vk_session_device(const asdf_vk_session* session, const char** text);
ASDF_VK_C_API void asdf_vk_session_destroy(asdf_vk_session* session);

/* Makes a scene of a triangle mesh. vertices: 3 * vertex_count numbers, x y z per vertex, of the type FLOAT64 or
 * FLOAT32. corners: 3 * face_count vertex indices of the type UINT32 or INT32, counter-clockwise seen from outside.
 * unit: "um", "mm", "cm", "m", "in", "ft", or null for no unit. Without a unit, a thickness limit such as "0.8mm" is
 * an error. The first computation prepares the mesh. */
ASDF_VK_C_API asdf_vk_status asdf_vk_scene_create(asdf_vk_session* session, const void* vertices,
                                                  asdf_vk_type vertex_type, size_t vertex_count, const void* corners,
                                                  asdf_vk_type corner_type, size_t face_count, const char* unit,
                                                  asdf_vk_scene** scene);
/* Makes a scene of a mesh of polygons. Face i has the corners corners[first_corner[i]] ..
 * corners[first_corner[i + 1] - 1]. first_corner: face_count + 1 numbers, ascending from 0 to the number of corners. */
ASDF_VK_C_API asdf_vk_status asdf_vk_scene_create_polygons(asdf_vk_session* session, const void* vertices,
                                                           asdf_vk_type vertex_type, size_t vertex_count,
                                                           const void* corners, asdf_vk_type corner_type,
                                                           const uint64_t* first_corner, size_t face_count,
                                                           const char* unit, asdf_vk_scene** scene);
/* Makes a scene of a mesh file: PLY, OFF, OBJ, STL, GLB, glTF or 3MF. */
ASDF_VK_C_API asdf_vk_status asdf_vk_scene_read(asdf_vk_session* session, const char* path, asdf_vk_scene** scene);

typedef struct asdf_vk_mesh {
  const double* vertices; /* 3 * vertex_count numbers, x y z per vertex. */
  size_t vertex_count;
  const uint32_t* triangles; /* 3 * triangle_count vertex indices. */
  size_t triangle_count;
  const uint32_t* face_of_triangle; /* triangle_count face indices; null if every face is one triangle. */
  size_t face_count;                /* Faces of the input; a field per face has one item per input face. */
  const char* unit;                 /* "" without a unit. */
} asdf_vk_mesh;
ASDF_VK_C_API asdf_vk_status asdf_vk_scene_mesh(const asdf_vk_scene* scene, asdf_vk_mesh* mesh);
ASDF_VK_C_API void asdf_vk_scene_destroy(asdf_vk_scene* scene);

/* Progress function of a caller. A computation calls this function about every 50 to 100 ms, in the thread and
 * floating-point environment of the caller. fraction: the finished fraction of the whole computation, 0 to 1. stage:
 * the current stage, "trace", "solve", ..., or "" before the first stage. A return value other than 0 requests a stop.
 * The function must not throw or call longjmp(). If the function starts a computation on a session that any computation
 * uses, the new computation fails. */
typedef int (*asdf_vk_progress)(double fraction, const char* stage, void* user);

/* Computes the fields and the report of a scene. options: must not hold options of a session; null: the defaults.
 * progress: may be null. user: passed to `progress`. */
ASDF_VK_C_API asdf_vk_status asdf_vk_compute(asdf_vk_scene* scene, const asdf_vk_options* options,
                                             asdf_vk_progress progress, void* user, asdf_vk_result** result);

/* Like asdf_vk_compute(), and compares the wall thickness with a former version of the mesh, a scene of the same
 * session: field "thickness_change", and "/comparison" of the report. See Scene::compare() in asdf_vk/scene.h. */
ASDF_VK_C_API asdf_vk_status asdf_vk_compare(asdf_vk_scene* scene, asdf_vk_scene* former,
                                             const asdf_vk_options* options, asdf_vk_progress progress, void* user,
                                             asdf_vk_result** result);

/* Computes the shape diameter at points, or the wall thickness if `options` has ("measure", "thickness"). points,
 * normals: 3 * point_count numbers each. values: receives point_count numbers in the unit of the mesh; NaN: no value.
 * options: must not hold an option without effect on these values. The options with an effect are those of the cone of
 * rays or of the opposing walls, "measure" and "orient". See Scene::valuesAt() and Scene::thicknessAt() in
 * asdf_vk/scene.h. */
ASDF_VK_C_API asdf_vk_status asdf_vk_values_at(asdf_vk_scene* scene, const asdf_vk_options* options,
                                               const double* points, const double* normals, size_t point_count,
                                               double* values, asdf_vk_progress progress, void* user);

/* One quantity of a result, for example "sdf", "thickness" or "segment" (docs/formats.md). */
typedef struct asdf_vk_field {
  const char* name;
  const char* unit; /* "length": the unit of the mesh; "": none. */
  asdf_vk_location location;
  asdf_vk_type type;   /* FLOAT64 (NaN: no value), UINT8 or UINT32. */
  uint32_t components; /* Numbers per item: 1, or 3 for a point. */
  size_t count;        /* Items: faces or vertices. */
  const void* data;    /* count * components numbers. */
} asdf_vk_field;

ASDF_VK_C_API asdf_vk_status asdf_vk_result_field_count(const asdf_vk_result* result, size_t* count);
ASDF_VK_C_API asdf_vk_status asdf_vk_result_field(const asdf_vk_result* result, size_t index, asdf_vk_field* field);
ASDF_VK_C_API asdf_vk_status asdf_vk_result_find(const asdf_vk_result* result, const char* name,
                                                 asdf_vk_location location, asdf_vk_field* field);
/* Copies a field into `numbers`, which has room for `capacity` numbers. capacity: at least count * components. Real
 * numbers can be copied as FLOAT64 or FLOAT32. Labels can be copied as any type except UINT8. Flags can be copied as
 * any type. In an INT32 copy, a face without a segment has the label -1. */
ASDF_VK_C_API asdf_vk_status asdf_vk_result_copy(const asdf_vk_result* result, const char* name,
                                                 asdf_vk_location location, asdf_vk_type type, void* numbers,
                                                 size_t capacity);
/* Returns a value of the report as JSON text. pointer: a JSON Pointer (RFC 6901), for example "/thickness/min"; "" for
 * the whole report. The report has the keys of the program's --json, except the names of files (docs/formats.md). */
ASDF_VK_C_API asdf_vk_status asdf_vk_result_json(asdf_vk_result* result, const char* pointer, const char** json);
/* Writes the mesh and all fields. The extension of the path decides the format: .ply .vtu .glb .obj .npy .npz .csv
 * (docs/formats.md). */
ASDF_VK_C_API asdf_vk_status asdf_vk_result_write(const asdf_vk_result* result, const char* path);
ASDF_VK_C_API void asdf_vk_result_destroy(asdf_vk_result* result);

/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
