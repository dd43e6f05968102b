/* Local thickness of triangle meshes: the interface in C99, for C, C#, Rust, Julia and others (docs/c.md).
 *
 * Functions return a status; asdf_vk_last_error() has the reason. A handle that is null, of another type or destroyed
 * is an error, not a crash. Handles may be used from any thread; calls on one session, and on its scenes, wait for each
 * other. Options are not set while another call uses them. No C++ exception leaves a function. Functions compute in the
 * default floating-point environment (rounding, traps, flushing of denormals), on all their threads, and restore that
 * of the caller, status flags included. In a process that was forked after the first call, all calls are errors.
 *
 * Arrays and texts that are passed are copied or read during the call only. Texts are UTF-8 and end with 0. Pointers
 * that a function returns belong to the object in its first argument and are valid until that object is destroyed.
 * Objects are destroyed in any order: a scene keeps its session, a result the mesh of its scene. The functions
 * asdf_vk_..._destroy() ignore null and destroyed handles, and do not wait for a computation. Where a function fails,
 * it leaves its outputs unchanged. */
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

/* Version of the binary interface, and of the shared library (libasdf-vk-c.so.1). Compare it with asdf_vk_abi(): the
 * library fits where both are equal. Within a version functions and enumerators are added only. */
#define ASDF_VK_ABI 1
ASDF_VK_C_API int asdf_vk_abi(void);
/* Version of asdf-vk: "0.2.0", and 10000 major + 100 minor + patch. */
ASDF_VK_C_API const char* asdf_vk_version(void);
ASDF_VK_C_API int asdf_vk_version_number(void);

/* The values are the exit codes of the program. */
typedef enum asdf_vk_status {
  ASDF_VK_OK = 0,
  ASDF_VK_USAGE =
      1, /* An argument is null or no such handle; an option is unknown, out of range or contradicts another. */
  ASDF_VK_INPUT = 2,      /* A mesh cannot be read, or there is nothing to compute on. */
  ASDF_VK_DEVICE = 3,     /* No usable device, or the device was lost or is too small. */
  ASDF_VK_OUTPUT = 4,     /* A file cannot be written. */
  ASDF_VK_INTERNAL = 70,  /* A defect of the library, or a limit of the system. */
  ASDF_VK_CANCELLED = 130 /* The progress function requested a stop. */
} asdf_vk_status;

/* One line with the reason of the last failure in this thread; "" before the first one. The text is valid until the
 * next failure in this thread. The name is that of ErrorCode in asdf_vk/error.h: "indexOutOfRange", "deviceLost". */
ASDF_VK_C_API const char* asdf_vk_last_error(void);
ASDF_VK_C_API const char* asdf_vk_last_error_name(void);

typedef enum asdf_vk_type {
  ASDF_VK_FLOAT64 = 0,
  ASDF_VK_FLOAT32 = 1,
  ASDF_VK_UINT8 = 2,
  ASDF_VK_UINT32 = 3,
  ASDF_VK_INT32 = 4
} asdf_vk_type;

typedef enum asdf_vk_location { ASDF_VK_PER_FACE = 0, ASDF_VK_PER_VERTEX = 1 } asdf_vk_location;

typedef struct asdf_vk_options asdf_vk_options; /* Values of options by name. */
typedef struct asdf_vk_session asdf_vk_session; /* A device with its pipelines, for many meshes. */
typedef struct asdf_vk_scene asdf_vk_scene;     /* A mesh on a session, for many computations. */
typedef struct asdf_vk_result asdf_vk_result;   /* The fields and the report of a computation. */

ASDF_VK_C_API asdf_vk_status asdf_vk_options_create(asdf_vk_options** options);
/* Sets an option to the value that a text has on the command line: ("seeds", "10%"), ("thinner-than", "0.8mm"). The
 * names are those of docs/options.md without the dashes. Flags are "on" or "off": ("estimate", "off"), ("centres",
 * "on"). A null value restores the default. Whether options contradict each other is checked where they are used. */
ASDF_VK_C_API asdf_vk_status asdf_vk_options_set(asdf_vk_options* options, const char* name, const char* value);
ASDF_VK_C_API void asdf_vk_options_destroy(asdf_vk_options* options);

/* Opens the device. options: those of a session ("backend", "device", "require-gpu", "threads"); null: the defaults. */
ASDF_VK_C_API asdf_vk_status asdf_vk_session_create(const asdf_vk_options* options, asdf_vk_session** session);
/* The chosen device and the reason; then a line per other device. The text is made when the session is created. */
ASDF_VK_C_API asdf_vk_status asdf_vk_session_device(const asdf_vk_session* session, const char** text);
ASDF_VK_C_API void asdf_vk_session_destroy(asdf_vk_session* session);

/* A mesh of triangles. vertices: 3 vertex_count numbers of the type FLOAT64 or FLOAT32, x y z. corners: 3 face_count
 * vertex indices of the type UINT32 or INT32, counter-clockwise seen from outside. unit: "um", "mm", "cm", "m", "in" or
 * "ft"; null: none, and limits with a unit are errors. The first computation prepares the mesh. */
ASDF_VK_C_API asdf_vk_status asdf_vk_scene_create(asdf_vk_session* session, const void* vertices,
                                                  asdf_vk_type vertex_type, size_t vertex_count, const void* corners,
                                                  asdf_vk_type corner_type, size_t face_count, const char* unit,
                                                  asdf_vk_scene** scene);
/* A mesh of polygons. Face i has the corners first_corner[i] .. first_corner[i + 1] - 1. first_corner: face_count + 1
 * numbers, ascending from 0 to the number of corners. */
ASDF_VK_C_API asdf_vk_status asdf_vk_scene_create_polygons(asdf_vk_session* session, const void* vertices,
                                                           asdf_vk_type vertex_type, size_t vertex_count,
                                                           const void* corners, asdf_vk_type corner_type,
                                                           const uint64_t* first_corner, size_t face_count,
                                                           const char* unit, asdf_vk_scene** scene);
/* The mesh of a file: PLY, OFF, OBJ, STL, GLB, glTF or 3MF. */
ASDF_VK_C_API asdf_vk_status asdf_vk_scene_read(asdf_vk_session* session, const char* path, asdf_vk_scene** scene);

typedef struct asdf_vk_mesh {
  const double* vertices; /* 3 vertex_count. */
  size_t vertex_count;
  const uint32_t* triangles; /* 3 triangle_count. */
  size_t triangle_count;
  const uint32_t* face_of_triangle; /* triangle_count; null where every face is one triangle. */
  size_t face_count;                /* Fields per face have one item for each. */
  const char* unit;                 /* "" where there is none. */
} asdf_vk_mesh;
ASDF_VK_C_API asdf_vk_status asdf_vk_scene_mesh(const asdf_vk_scene* scene, asdf_vk_mesh* mesh);
ASDF_VK_C_API void asdf_vk_scene_destroy(asdf_vk_scene* scene);

/* Called in the thread and in the floating-point environment of the caller, about every 50 to 100 ms. fraction: 0 to 1.
 * stage: "trace", "solve", ..., or "" before the first one. A return value other than 0 requests a stop. Must not
 * throw, nor leave by longjmp(). A computation on the same session is an error. */
typedef int (*asdf_vk_progress)(double fraction, const char* stage, void* user);

/* options: those of a computation; null: the defaults. progress: may be null. user: passed to it. */
ASDF_VK_C_API asdf_vk_status asdf_vk_compute(asdf_vk_scene* scene, const asdf_vk_options* options,
                                             asdf_vk_progress progress, void* user, asdf_vk_result** result);

/* The shape diameter at points, or with ("measure", "thickness") the wall thickness. points, normals: 3 point_count
 * numbers. values: point_count numbers, in the unit of the mesh; NaN: no value. Of the options only those of rays,
 * thickness and orientation have an effect. See Scene::valuesAt() and thicknessAt() in asdf_vk/scene.h. */
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
/* Copies a field into an array of the caller. capacity: its size in numbers, at least count * components. Real numbers
 * are converted to FLOAT64 or FLOAT32, flags and labels to any type; in INT32 the label of no part is -1. */
ASDF_VK_C_API asdf_vk_status asdf_vk_result_copy(const asdf_vk_result* result, const char* name,
                                                 asdf_vk_location location, asdf_vk_type type, void* numbers,
                                                 size_t capacity);
/* A value of the report in JSON, by its JSON Pointer (RFC 6901): "/thickness/min" is a number as text. "" is the whole
 * report, with the keys of the program's --json but those of files (docs/formats.md). */
ASDF_VK_C_API asdf_vk_status asdf_vk_result_json(asdf_vk_result* result, const char* pointer, const char** json);
/* Writes the mesh and all fields in the format of the extension: .ply .vtu .glb .obj .npy .npz .csv (docs/formats.md).
 */
ASDF_VK_C_API asdf_vk_status asdf_vk_result_write(const asdf_vk_result* result, const char* path);
ASDF_VK_C_API void asdf_vk_result_destroy(asdf_vk_result* result);

/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
