# Configures and builds SOURCE in FOLDER in one way, and computes a mesh with the built program.
#   -DWAY=plain      CMake without a preset
#   -DWAY=develop    the preset
#   -DWAY=debug      the preset
#   -DWAY=smallest   without Vulkan, OpenMesh, Draco, meshoptimizer and the library for C
set(arguments -S ${SOURCE} -B ${FOLDER})
if(WAY STREQUAL "plain")
  list(APPEND arguments -DCMAKE_BUILD_TYPE=Release)
elseif(WAY STREQUAL "smallest")
  list(APPEND arguments -G Ninja -DCMAKE_BUILD_TYPE=Release -DASDF_VK_VULKAN=OFF -DASDF_VK_C=OFF -DASDF_VK_INSTALL=OFF
       -DASDF_VK_STEP=OFF -DASDF_VK_DRACO=OFF -DASDF_VK_MESHOPTIMIZER=OFF -DCMAKE_DISABLE_FIND_PACKAGE_OpenMesh=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0
       -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DASDF_VK_WERROR=ON)
else()
  list(APPEND arguments --preset ${WAY})
endif()
cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)

function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${SOURCE} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} ${arguments})
run(${CMAKE_COMMAND} --build ${FOLDER} -j ${processors})
set(program ${FOLDER}/src/asdf-vk)
run(${program}-generate animal --faces 2000 -o ${FOLDER}/mesh.ply)
run(${program} ${FOLDER}/mesh.ply -o ${FOLDER}/values.npy)
run(${program} ${FOLDER}/mesh.ply --backend reference -o ${FOLDER}/values.npy)

# The exit code and the output of the program must be as expected.
function(expect code pattern)
  execute_process(COMMAND ${program} ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL code OR NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "asdf-vk ${ARGN}: exit code ${result} instead of ${code}, or an unexpected output:\n${output}")
  endif()
endfunction()

if(WAY STREQUAL "smallest")
  set(corpus ${SOURCE}/tests/io/assembly_corpus)
  expect(2 "build it with libdraco-dev" ${corpus}/glb_draco.glb -o ${FOLDER}/values.npy)
  expect(2 "build it with libmeshoptimizer-dev" ${corpus}/glb_meshopt.glb -o ${FOLDER}/values.npy)
  expect(3 "this build of asdf-vk has no Vulkan" ${FOLDER}/mesh.ply --backend vulkan -o ${FOLDER}/values.npy)
  expect(0 "this build of asdf-vk has no Vulkan" --list-devices)
  file(WRITE ${FOLDER}/part.step "ISO-10303-21;\nEND-ISO-10303-21;\n")
  expect(2 "read by a module that is not installed" ${FOLDER}/part.step -o ${FOLDER}/values.npy)
  expect(3 "this build of asdf-vk has no Vulkan" --device-report)
  expect(3 "the solver cg runs on a Vulkan device" ${FOLDER}/mesh.ply --solver cg -o ${FOLDER}/values.npy)
endif()
