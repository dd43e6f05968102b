// The one translation unit that holds Volk's function pointers.
#define VOLK_IMPLEMENTATION
#include <volk.h>
