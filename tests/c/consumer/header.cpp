// The header in C compiles as C++98, too.
#include <asdf_vk/asdf_vk_c.h>
