# Tests on the fake devices: fake-DEVICE-FOLDER with the label `fake` has the cases below that use a device. `ctest -C
# devices` adds fake-DEVICE-FOLDER-all with the label `fake-all`: all cases, which takes minutes.
set(casesOf_vk "*")
set(casesOf_trace "turned cones*" "all tracers agree on cones*" "hits of cones that the reference redoes*"
    "hits do not depend on where a chunk ends" "hits on the device*" "rays without a hit are misses*"
    "copies of faces*" "two runs on the device*" "a trace on the device stops*" "details too small*"
    "the kernel is chosen by*" "each field of the shared structs*" "a hierarchy beyond the texel limit*")
set(casesOf_trace_lanes128 "any number of rays gives the reference's hits")
set(casesOf_poisson "iterations*" "Jacobi sweeps*" "a distinct word*" "a torus has the solution*"
    "solvers of a device*" "the solution is that of dense algebra*")
set(casesOf_pipeline "a tenth of the faces casts*" "two runs give the same bits" "all solvers give*"
    "a warning reports that the CPU finished*" "the device and the reference agree*"
    "a session computes by both definitions*" "a stop request*" "a point has the same value alone*"
    "a region of all faces*")
# Test cases of the prediction are selected by the files of its kernels.
set(casesOf_predict "*")
set(filesOf_predict "*vulkan*")

# Fails if no test case matches a pattern, because the case may have been renamed.
function(asdfvk_require_cases folder)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*_test.cpp)
  set(all "")
  foreach(source IN LISTS sources)
    file(READ ${source} text)
    string(APPEND all "${text}")
  endforeach()
  foreach(pattern IN LISTS ARGN)
    string(REGEX REPLACE "\\*$" "" begin "${pattern}")
    string(FIND "${all}" "TEST_CASE(\"${begin}" at)
    if(at EQUAL -1)
      message(FATAL_ERROR "no test case of tests/${folder} begins with: ${begin}")
    endif()
  endforeach()
endfunction()

function(asdfvk_fake_device_tests device folder)
  set(run ${ASDFVK_FAKE_DEVICE_DIR}/${device} $<TARGET_FILE:asdfvk-test-${folder}>
      --source-file-exclude=*real_meshes_test.cpp)
  set(cases ${casesOf_${folder}} ${casesOf_${folder}_${device}})
  asdfvk_require_cases(${folder} ${cases})
  list(JOIN cases "," cases)
  set(files "*")
  if(filesOf_${folder})
    set(files ${filesOf_${folder}})
    file(GLOB present CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/${files}_test.cpp)
  endif()
  add_dependencies(asdfvk-test-${folder} asdfvk-fake-device)
  if(present OR NOT filesOf_${folder})
    add_test(NAME fake-${device}-${folder} COMMAND ${run} --test-suite-exclude=slow --test-case=${cases} --source-file=${files})
    set_tests_properties(fake-${device}-${folder} PROPERTIES LABELS fake FAIL_REGULAR_EXPRESSION "test cases: +0 ")
  endif()
  add_test(NAME fake-${device}-${folder}-all CONFIGURATIONS devices COMMAND ${run})
  set_tests_properties(fake-${device}-${folder}-all PROPERTIES LABELS fake-all)
endfunction()

foreach(device IN LISTS ASDFVK_FAKE_DEVICES)
  foreach(folder vk trace poisson predict pipeline)
    asdfvk_fake_device_tests(${device} ${folder})
  endforeach()
endforeach()
