// The one translation unit with the function pointers of Volk.
#define VOLK_IMPLEMENTATION
#include <volk.h>
