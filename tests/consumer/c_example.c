/* The example of docs/c.md, compiled and run by the tests of consumers. */
#include <asdf_vk/asdf_vk_c.h>
#include <stdio.h>

static const double vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
static const uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

int main(void) {
  asdf_vk_options* options = NULL;
  asdf_vk_session* session = NULL;
  asdf_vk_scene* scene = NULL;
  asdf_vk_result* result = NULL;
  double values[4];
  if (asdf_vk_options_create(&options) || asdf_vk_options_set(options, "measure", "thickness") ||
      asdf_vk_session_create(NULL, &session) || /* opens the device once, for many meshes */
      asdf_vk_scene_create(session, vertices, ASDF_VK_FLOAT64, 4, triangles, ASDF_VK_UINT32, 4, NULL, &scene) ||
      asdf_vk_compute(scene, options, NULL, NULL, &result) ||
      asdf_vk_result_copy(result, "thickness", ASDF_VK_PER_FACE, ASDF_VK_FLOAT64, values, 4))
    fprintf(stderr, "%s\n", asdf_vk_last_error());
  else
    printf("thickness at face 0: %g\n", values[0]);
  asdf_vk_result_destroy(result);
  asdf_vk_scene_destroy(scene);
  asdf_vk_session_destroy(session);
  asdf_vk_options_destroy(options);
  return result == NULL;
}
