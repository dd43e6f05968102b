# Programs with man pages and completion, libraries, headers, CMake package and pkg-config files, in the folders of
# GNUInstallDirs. Components: program, development, c (the shared library for C without files for linking), python, step (the
# module that reads STEP).
include(CMakePackageConfigHelpers)

set(packageFolder ${CMAKE_INSTALL_LIBDIR}/cmake/asdf-vk)
install(TARGETS asdfvk-library EXPORT asdf-vk-targets COMPONENT development)
if(TARGET asdf-vk-c)
  install(TARGETS asdf-vk-c EXPORT asdf-vk-targets LIBRARY COMPONENT c NAMELINK_COMPONENT development)
endif()
if(ASDF_VK_PROGRAM)
  install(TARGETS asdf-vk asdf-vk-generate COMPONENT program)

  find_program(ASDF_VK_GZIP gzip REQUIRED)
  mark_as_advanced(ASDF_VK_GZIP)
  set(manPages ${PROJECT_BINARY_DIR}/man1)
  set(pageSources ${PROJECT_SOURCE_DIR}/docs/man/asdf-vk.1 ${PROJECT_SOURCE_DIR}/docs/man/asdf-vk-generate.1)
  add_custom_command(OUTPUT ${manPages}/asdf-vk.1.gz
                     COMMAND asdfvk-write-documents ${PROJECT_SOURCE_DIR} ${manPages}
                     COMMAND ${ASDF_VK_GZIP} -9nf ${manPages}/asdf-vk.1 ${manPages}/asdf-vk-generate.1
                     DEPENDS ${pageSources} COMMENT "Writing man pages" VERBATIM)
  add_custom_target(asdfvk-documents-files ALL DEPENDS ${manPages}/asdf-vk.1.gz)
  install(DIRECTORY ${manPages} DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
  foreach(program asdf-vk asdf-vk-generate)
    install(FILES documents/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
            RENAME ${program} COMPONENT program)
  endforeach()
endif()
if(TARGET asdf-vk-step)  # src/io/dl/step_library.cpp searches the module there.
  install(TARGETS asdf-vk-step LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/asdf-vk COMPONENT step)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/asdf_vk ${PROJECT_BINARY_DIR}/include/asdf_vk
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING PATTERN "*.h")
install(EXPORT asdf-vk-targets NAMESPACE asdf-vk:: DESTINATION ${packageFolder} COMPONENT development)

get_target_property(libraryType asdfvk-library TYPE)
set(ASDFVK_IS_STATIC OFF)
set(ASDFVK_PC_PRIVATE "")
if(libraryType STREQUAL STATIC_LIBRARY)
  set(ASDFVK_IS_STATIC ON)
  set(ASDFVK_PC_PRIVATE "-lfmt -ltbb -lz -lexpat -lpthread -ldl")
  foreach(library draco meshoptimizer)
    if(${library}_FOUND)
      string(APPEND ASDFVK_PC_PRIVATE " -l${library}")
    endif()
  endforeach()
endif()
configure_package_config_file(asdf-vk-config.cmake.in ${PROJECT_BINARY_DIR}/asdf-vk-config.cmake
                              INSTALL_DESTINATION ${packageFolder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/asdf-vk-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/asdf-vk-config.cmake ${PROJECT_BINARY_DIR}/asdf-vk-config-version.cmake
        DESTINATION ${packageFolder} COMPONENT development)
# Relative to the file itself, because `cmake --install --prefix` may change the prefix.
set(pkgConfigFolder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
set(ASDFVK_PC_PREFIX ${CMAKE_INSTALL_PREFIX})
if(NOT IS_ABSOLUTE "${pkgConfigFolder}")
  file(RELATIVE_PATH prefixFromFile "/${pkgConfigFolder}" "/")
  set(ASDFVK_PC_PREFIX "\${pcfiledir}/${prefixFromFile}")
endif()
set(ASDFVK_PC_LIBDIR "\${prefix}")
set(ASDFVK_PC_INCLUDEDIR "\${prefix}")
cmake_path(APPEND ASDFVK_PC_LIBDIR "${CMAKE_INSTALL_LIBDIR}")
cmake_path(APPEND ASDFVK_PC_INCLUDEDIR "${CMAKE_INSTALL_INCLUDEDIR}")
foreach(pcName asdf-vk asdf-vk-c)
  if(pcName STREQUAL "asdf-vk-c")
    if(NOT TARGET asdf-vk-c)
      continue()
    endif()
    set(ASDFVK_PC_PRIVATE "")
  endif()
  configure_file(asdf-vk.pc.in ${PROJECT_BINARY_DIR}/${pcName}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${pcName}.pc DESTINATION ${pkgConfigFolder} COMPONENT development)
endforeach()
