# Configures, builds and runs the consumer in FOLDER, from a current directory of its own.
#   -DMODE=installed   installs BUILD into FOLDER/prefix first
#   -DMODE=configured     adds SOURCE as a subdirectory, and configures only
#   -DMODE=subdirectory   the same, built and run
#   -DGENERATE=FILE   asdf-vk-generate, for the mesh of the README example
function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${FOLDER}/elsewhere COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER}/elsewhere)
set(arguments -G Ninja -S ${SOURCE}/tests/consumer -B ${FOLDER}/build -DCMAKE_BUILD_TYPE=Release)
if(MODE STREQUAL "installed")
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix)
  list(APPEND arguments -DCMAKE_PREFIX_PATH=${FOLDER}/prefix)
else()
  list(APPEND arguments -DASDF_VK_SOURCE=${SOURCE} -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0
       -DCMAKE_CXX_FLAGS_RELEASE=-O0)
endif()
run(${CMAKE_COMMAND} ${arguments})
if(MODE STREQUAL "configured")
  return()
endif()
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
run(${GENERATE} animal --faces 2000 -o mesh.ply)
run(${FOLDER}/build/arrays)
run(${FOLDER}/build/readme_example mesh.ply)
if(NOT EXISTS ${FOLDER}/elsewhere/result.vtu)
  message(FATAL_ERROR "the README example wrote no result")
endif()
if(MODE STREQUAL "installed")
  run(${FOLDER}/prefix/bin/asdf-vk --version)
  find_program(PKG_CONFIG pkg-config)
  if(PKG_CONFIG)
    file(GLOB_RECURSE file ${FOLDER}/prefix/*/asdf-vk.pc)
    get_filename_component(folder ${file} DIRECTORY)
    execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder} ${PKG_CONFIG} --cflags --libs asdf-vk
                    OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    separate_arguments(flags UNIX_COMMAND "${flags}")
    run(c++ -std=c++20 ${SOURCE}/tests/consumer/arrays.cpp -o ${FOLDER}/arrays_by_pkg_config ${flags})
    run(${FOLDER}/arrays_by_pkg_config)
  endif()
endif()
