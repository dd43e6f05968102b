# asdf-vk.html, the page that checks parts: one file with the page, the module and the worker of engine.cmake.
find_package(Python REQUIRED COMPONENTS Interpreter)
set(web ${CMAKE_CURRENT_SOURCE_DIR}/web)
set(page ${CMAKE_CURRENT_SOURCE_DIR}/page)
set(template ${CMAKE_CURRENT_BINARY_DIR}/web_template.html)
set(output ${PROJECT_BINARY_DIR}/asdf-vk.html)
file(GLOB sources CONFIGURE_DEPENDS ${page}/browser/* ${web}/browser/*)
add_custom_command(OUTPUT ${output}
                   COMMAND ${CMAKE_COMMAND} -DPAGE=${page}/browser -DWEB=${web}/browser -DOUTPUT=${template} -P ${page}/bundle.cmake
                   COMMAND ${Python_EXECUTABLE} ${web}/pack.py ${template} ${output}
                           engine-module=$<TARGET_FILE_DIR:asdfvk-engine>/asdfvk-engine.wasm
                           engine-worker=${PROJECT_BINARY_DIR}/engine-worker.js
                   DEPENDS ${sources} ${page}/bundle.cmake ${web}/pack.py asdfvk-engine ${PROJECT_BINARY_DIR}/engine-worker.js
                   COMMENT "Bundling asdf-vk.html" VERBATIM)
add_custom_target(asdfvk-web-page ALL DEPENDS ${output})
