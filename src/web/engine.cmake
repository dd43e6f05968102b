# The WebAssembly module of the page that checks meshes: asdfvk-engine.wasm, and its loader asdfvk-engine.js with the
# function makeModule(). The module has up to 4 GB of memory. If it is used up, operator new throws as in the program.
add_executable(asdfvk-engine web/wasm/entry_points.cpp)
target_link_libraries(asdfvk-engine PRIVATE asdfvk-web)
target_link_options(asdfvk-engine PRIVATE --no-entry -O3 -sENVIRONMENT=worker -sMODULARIZE -sEXPORT_NAME=makeModule
                    -sALLOW_MEMORY_GROWTH -sMAXIMUM_MEMORY=4GB -sABORTING_MALLOC=0 -sSTACK_SIZE=8MB -sWASM_BIGINT
                    -sDYNAMIC_EXECUTION=0 -sFORCE_FILESYSTEM
                    -sEXPORTED_FUNCTIONS=_malloc,_free
                    -sEXPORTED_RUNTIME_METHODS=FS,HEAPU8,UTF8ToString,stringToNewUTF8)
# The script of the worker: the loader and src/web/browser/worker.js.
set(worker ${CMAKE_CURRENT_SOURCE_DIR}/web/browser/worker.js)
set(script ${PROJECT_BINARY_DIR}/engine-worker.js)
add_custom_command(OUTPUT ${script}
                   COMMAND ${CMAKE_COMMAND} -E cat $<TARGET_FILE:asdfvk-engine> ${worker} > ${script}
                   COMMAND ${CMAKE_COMMAND} -E copy $<TARGET_FILE_DIR:asdfvk-engine>/asdfvk-engine.wasm
                           ${PROJECT_BINARY_DIR}
                   DEPENDS asdfvk-engine ${worker} VERBATIM)
add_custom_target(asdfvk-engine-files ALL DEPENDS ${script})
