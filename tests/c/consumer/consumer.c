/* A program in C99 on the shared library: values.bin and result.npy of MESH, which run.cmake compares with those of the
 * program, in a floating-point environment with traps and upward rounding.
 *   consumer MESH */
#define _GNU_SOURCE /* feenableexcept() */
#include <asdf_vk/asdf_vk_c.h>
#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void require(int condition, const char* what) {
  if (condition) return;
  fprintf(stderr, "consumer: %s: %s\n", what, asdf_vk_last_error());
  exit(1);
}

static int countCalls(double fraction, const char* stage, void* user) {
  (void)fraction;
  require(stage != NULL && fegetround() == FE_UPWARD, "the progress function");
  ++*(int*)user;
  return 0;
}

static int stop(double fraction, const char* stage, void* user) {
  (void)fraction, (void)stage, (void)user;
  return 1;
}

int main(int argc, char** argv) {
  asdf_vk_options* options = NULL;
  asdf_vk_session* session = NULL;
  asdf_vk_scene* scene = NULL;
  asdf_vk_scene* copy = NULL;
  asdf_vk_result* result = NULL;
  asdf_vk_mesh mesh;
  asdf_vk_field field;
  const char* text = NULL;
  float* values = NULL;
  FILE* file = NULL;
  int callCount = 0;
  char number[16];
  int traps;
  if (argc != 2) return 2;
  fesetround(FE_UPWARD);
  feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
  traps = fegetexcept(); /* None where the processor has no traps. */

  require(asdf_vk_abi() == ASDF_VK_ABI, "asdf_vk_abi");
  sprintf(number, "%d.%d.%d", asdf_vk_version_number() / 10000, asdf_vk_version_number() / 100 % 100,
          asdf_vk_version_number() % 100);
  require(strcmp(number, asdf_vk_version()) == 0, "asdf_vk_version");
  require(asdf_vk_options_create(&options) == ASDF_VK_OK, "options");
  require(asdf_vk_options_set(options, "backend", "cpu") == ASDF_VK_OK, "backend");
  require(asdf_vk_session_create(options, &session) == ASDF_VK_OK, "session");
  require(asdf_vk_session_device(session, &text) == ASDF_VK_OK && text[0] != 0, "device");
  require(asdf_vk_options_set(options, "backend", NULL) == ASDF_VK_OK, "backend");
  require(asdf_vk_options_set(options, "seeds", "20%") == ASDF_VK_OK, "seeds");
  require(asdf_vk_scene_read(session, argv[1], &scene) == ASDF_VK_OK, "read");
  require(asdf_vk_scene_mesh(scene, &mesh) == ASDF_VK_OK && mesh.face_of_triangle == NULL, "mesh");
  require(asdf_vk_scene_create(session, mesh.vertices, ASDF_VK_FLOAT64, mesh.vertex_count, mesh.triangles,
                               ASDF_VK_UINT32, mesh.triangle_count, NULL, &copy) == ASDF_VK_OK,
          "scene");
  asdf_vk_scene_destroy(scene);
  require(asdf_vk_compute(copy, options, stop, NULL, &result) == ASDF_VK_CANCELLED && result == NULL, "cancelled");
  require(asdf_vk_compute(copy, options, countCalls, &callCount, &result) == ASDF_VK_OK && callCount > 3, "compute");
  asdf_vk_session_destroy(session);
  asdf_vk_scene_destroy(copy);
  asdf_vk_options_destroy(options);

  require(asdf_vk_result_find(result, "sdf", ASDF_VK_PER_FACE, &field) == ASDF_VK_OK, "sdf");
  values = malloc(field.count * sizeof *values);
  require(asdf_vk_result_copy(result, "sdf", ASDF_VK_PER_FACE, ASDF_VK_FLOAT32, values, field.count) == ASDF_VK_OK,
          "copy");
  file = fopen("values.bin", "wb");
  require(file != NULL && fwrite(values, sizeof *values, field.count, file) == field.count, "values.bin");
  fclose(file);
  free(values);
  require(asdf_vk_result_write(result, "result.npy") == ASDF_VK_OK, "write");
  require(asdf_vk_result_json(result, "/faceCount", &text) == ASDF_VK_OK && strtoul(text, NULL, 10) == field.count,
          "json");
  require(asdf_vk_result_find(result, "width", ASDF_VK_PER_FACE, &field) == ASDF_VK_USAGE &&
              strcmp(asdf_vk_last_error_name(), "unknownField") == 0,
          "unknown field");
  asdf_vk_result_destroy(result);
  require(fegetround() == FE_UPWARD && fegetexcept() == traps, "environment");
  return 0;
}
