// Linked into every program of a sanitizer build, so that it needs no environment to run cleanly.

extern "C" {

// The report of a leak contains its library only while the library is loaded: without this, drivers that were unloaded
// by the end of the program leave "unknown module", which no suppression can name.
int dlclose(void*) { return 0; }

const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() {
  return "leak:libvulkan_lvp\n"                   // Mesa's software device.
         "leak:libLLVM\n"                         // Its compiler.
         "leak:libVkLayer_khronos_validation\n";  // The layer itself reports leaked Vulkan objects.
}

const char* __lsan_default_options();
const char* __lsan_default_options() { return "print_suppressions=0"; }

const char* __ubsan_default_options();
const char* __ubsan_default_options() { return "print_stacktrace=1"; }
}
