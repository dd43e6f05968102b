# Fails when one of the object files OBJECTS, compiled for wider instructions than the rest of the program, defines a
# symbol that another file could be linked with instead of its own: an inline function or a template of a header, say,
# which would then end the program on a machine without these instructions. NM: the program that lists symbols.
cmake_minimum_required(VERSION 3.25)
if(NOT OBJECTS)
  message(FATAL_ERROR "no object file was given")
endif()
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} --demangle --defined-only --extern-only --format=posix ${object}
                  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE " [A-Za-z] [0-9a-f]+( [0-9a-f]+)?\n" ";" symbols "${symbols}")
  set(kernels ${symbols})
  list(FILTER kernels INCLUDE REGEX "^asdfvk::avx[0-9]+ConeKernel\\(\\)$")
  list(LENGTH kernels kernelCount)
  if(NOT kernelCount EQUAL 1)
    message(SEND_ERROR "${object} has not one kernel but ${kernelCount}")
  endif()
  # What is named after the width (src/core/lanes.h) is nobody else's; without optimisation it is not all inlined. Some
  # sanitizers add the names of types and a pointer, which are no code.
  list(FILTER symbols EXCLUDE REGEX "^asdfvk::(avx[0-9]+ConeKernel\\(\\)$|lanesBy(8|16)::)|^typeinfo (name )?for |^DW[.]ref[.]|^$")
  foreach(symbol IN LISTS symbols)
    message(SEND_ERROR "${object} defines ${symbol}, which other files could be linked with")
  endforeach()
endforeach()
