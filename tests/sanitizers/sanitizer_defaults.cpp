// Linked into every program of a sanitizer build, so that it needs no environment to run cleanly.

extern "C" {

// A leak is told with its library only while that is loaded: without this, drivers that were unloaded by the end of the
// program leave "unknown module", which no suppression can name.
int dlclose(void*) { return 0; }

const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() {
  return "leak:libvulkan_lvp\n"                   // Mesa's software device.
         "leak:libLLVM\n"                         // Its compiler.
         "leak:libVkLayer_khronos_validation\n";  // It tells of Vulkan objects that we leak by itself.
}

const char* __lsan_default_options();
const char* __lsan_default_options() { return "print_suppressions=0"; }

const char* __ubsan_default_options();
const char* __ubsan_default_options() { return "print_stacktrace=1"; }
}
