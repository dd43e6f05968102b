# Programs, library, headers, CMake package and pkg-config file, in the folders of GNUInstallDirs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(packageFolder ${CMAKE_INSTALL_LIBDIR}/cmake/asdf-vk)
install(TARGETS asdfvk-library EXPORT asdf-vk-targets)
if(ASDF_VK_PROGRAM)
  install(TARGETS asdf-vk asdf-vk-generate)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/asdf_vk ${PROJECT_BINARY_DIR}/include/asdf_vk
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT asdf-vk-targets NAMESPACE asdf-vk:: DESTINATION ${packageFolder})

get_target_property(libraryType asdfvk-library TYPE)
set(ASDFVK_IS_STATIC OFF)
set(ASDFVK_PC_PRIVATE "")
if(libraryType STREQUAL STATIC_LIBRARY)
  set(ASDFVK_IS_STATIC ON)
  set(ASDFVK_PC_PRIVATE "-lfmt -ltbb -lz -lpthread -ldl")
  if(TARGET embree)
    string(APPEND ASDFVK_PC_PRIVATE " -lembree3")
  endif()
endif()
set(ASDFVK_HAS_EMBREE OFF)
if(TARGET embree)
  set(ASDFVK_HAS_EMBREE ON)
endif()
configure_package_config_file(asdf-vk-config.cmake.in ${PROJECT_BINARY_DIR}/asdf-vk-config.cmake
                              INSTALL_DESTINATION ${packageFolder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/asdf-vk-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/asdf-vk-config.cmake ${PROJECT_BINARY_DIR}/asdf-vk-config-version.cmake
        DESTINATION ${packageFolder})
configure_file(asdf-vk.pc.in ${PROJECT_BINARY_DIR}/asdf-vk.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/asdf-vk.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
