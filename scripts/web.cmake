# Toolchain of scripts/web: compiles to WebAssembly with Debian's Emscripten. The libraries are in /root/libs, where
# scripts/web compiles them.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
list(APPEND CMAKE_FIND_ROOT_PATH /root/libs)
# Vectors of 128 bits. Exceptions of WebAssembly cost nothing until they are thrown. The option -fexperimental-library is for
# <stop_token>.
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fwasm-exceptions -fexperimental-library")
