# Debian packages by CPack: asdf-vk, libasdf-vk-dev, libasdf-vk-c1 (with the ABI of the interface in C), and
# python3-asdf-vk and asdf-vk-step if these modules are built. A package is an install component. scripts/release runs these
# commands:
#   cmake --preset packages && cmake --build --preset packages && cpack --preset packages
include(GNUInstallDirs)
set(components program development c)
if(TARGET asdfvk-python)
  list(APPEND components python)
endif()
if(TARGET asdf-vk-step)
  list(APPEND components step)
endif()
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGE_NAME asdf-vk)
# The version names the system, for example 0.2.0+debian12: packages depend on libraries of one release of the system.
cmake_host_system_information(RESULT system QUERY DISTRIB_ID)
cmake_host_system_information(RESULT systemVersion QUERY DISTRIB_VERSION_ID)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION}+${system}${systemVersion})
set(CPACK_PACKAGE_CONTACT "The asdf-vk authors <maintainers@asdf-vk.example>")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/deb)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
    WORLD_EXECUTE)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${CPACK_PACKAGE_CONTACT}")
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

# The programs open the Vulkan loader at run time. Without the loader, they work on the CPU.
set(vulkan "libvulkan1, mesa-vulkan-drivers | vulkan-icd")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # The first line of a description is the summary.
set(description
"The local thickness of a shape at each face of its surface is the shape
diameter function or the wall thickness. The first serves to segment,
skeletonise and retrieve shapes, the second to check walls. For the shape
diameter function, rays from a tenth of the faces are traced by Vulkan
compute or on the CPU, and the values of the other faces are
interpolated. The error is estimated. Parts are computed from these values.
The wall thickness is exact and needs no rays.

")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME asdf-vk)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The option --tar loads libarchive at run time.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "${vulkan}, libarchive13 | libarchive13t64")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS asdf-vk-step)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "local thickness of triangle meshes by Vulkan compute
${description}This package has the programs asdf-vk and asdf-vk-generate.")

# Dependencies of asdf-vk-config.cmake. The static library is bound to the symbols of one major version of fmt.
string(REGEX MATCH "^[0-9]+" fmtMajor "${fmt_VERSION}")
math(EXPR fmtNext "${fmtMajor} + 1")
set(depends "libfmt-dev (>= ${fmtMajor}), libfmt-dev (<< ${fmtNext}), libtbb-dev (>= 2021), zlib1g-dev, libexpat1-dev")
foreach(library draco meshoptimizer)
  if(${library}_FOUND)
    string(APPEND depends ", lib${library}-dev")
  endif()
endforeach()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libasdf-vk-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
get_target_property(abi asdf-vk-c SOVERSION)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libasdf-vk-c${abi} (= ${CPACK_PACKAGE_VERSION}), ${depends}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "${vulkan}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS libopenmesh-dev)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "local thickness of triangle meshes - development files
${description}This package has the static library, its headers, a CMake package and
pkg-config files, also of the shared library for C.")

set(CPACK_DEBIAN_C_PACKAGE_NAME libasdf-vk-c${abi})
set(CPACK_DEBIAN_C_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_C_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_C_PACKAGE_RECOMMENDS "${vulkan}")
set(CPACK_DEBIAN_C_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/shlibs ${PROJECT_BINARY_DIR}/debian/triggers)
set(CPACK_DEBIAN_C_DESCRIPTION "local thickness of triangle meshes - library for C
${description}This package has the shared library of the interface in C.")

set(CPACK_DEBIAN_STEP_PACKAGE_NAME asdf-vk-step)
set(CPACK_DEBIAN_STEP_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_STEP_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_STEP_PACKAGE_ENHANCES "asdf-vk, libasdf-vk-dev, libasdf-vk-c${abi}, python3-asdf-vk")
set(CPACK_DEBIAN_STEP_DESCRIPTION "local thickness of triangle meshes - reader of STEP
${description}This package has the module that reads STEP files by Open CASCADE.")

# The module is bound to the minor version of the Python for which it is built.
if(TARGET asdfvk-python)
  math(EXPR pythonNext "${Python_VERSION_MINOR} + 1")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-asdf-vk)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${pythonNext}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "${vulkan}")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "local thickness of triangle meshes - Python module
${description}This package has the Python module asdf_vk, and cgal_Segmentation_Module for
programs that call that extension of CGAL.")

# Files for /usr/share/doc, and maintainer scripts. The changelog has the version of the project; NEWS is CHANGELOG.md.
set(folder ${PROJECT_BINARY_DIR}/debian)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/LICENSE
             ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
function(writeGzip text name)
  file(WRITE ${folder}/${name} "${text}")
  execute_process(COMMAND ${ASDF_VK_GZIP} -9nf ${folder}/${name} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(READ ${PROJECT_SOURCE_DIR}/LICENSE license)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]*)\n\n(.*)" ignored "${license}")
set(holder "${CMAKE_MATCH_1}")
string(REGEX REPLACE "\n+$" "" license "${CMAKE_MATCH_2}")
string(REPLACE "\n\n" "\n.\n" license "${license}")
string(REPLACE "\n" "\n " license "${license}")
file(WRITE ${folder}/copyright
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: asdf-vk

Files: *
Copyright: ${holder}
License: Expat

License: Expat
 ${license}
")

file(READ ${PROJECT_SOURCE_DIR}/CHANGELOG.md changes)
writeGzip("${changes}" NEWS)
set(date "")
if(GIT_FOUND AND NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${PROJECT_SOURCE_DIR} log -1 --format=%cD OUTPUT_VARIABLE date
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT date)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
endif()
writeGzip("asdf-vk (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Version ${PROJECT_VERSION}; its changes are in NEWS.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
" changelog)

file(WRITE ${folder}/shlibs "libasdf-vk-c ${abi} libasdf-vk-c${abi} (>= ${PROJECT_VERSION})\n")
file(WRITE ${folder}/triggers "activate-noawait ldconfig\n")
# Maintainer scripts of CPack already call ldconfig.
file(WRITE ${folder}/libasdf-vk-c${abi} "libasdf-vk-c${abi}: maintscript-calls-ldconfig\n")
install(FILES ${folder}/libasdf-vk-c${abi} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT c)

# Removes the bytecode together with the package.
file(WRITE ${folder}/postinst "#!/bin/sh
set -e
if [ \"$1\" = configure ] && command -v py3compile >/dev/null; then
  py3compile -p python3-asdf-vk
fi
")
file(WRITE ${folder}/prerm "#!/bin/sh
set -e
if command -v py3clean >/dev/null; then
  py3clean -p python3-asdf-vk
fi
")
file(CHMOD ${folder}/postinst ${folder}/prerm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
     WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${folder}/postinst ${folder}/prerm)

# Removes sections that only name the compiler.
find_program(ASDF_VK_STRIP strip REQUIRED)
mark_as_advanced(ASDF_VK_STRIP)
file(WRITE ${folder}/strip.cmake "
file(GLOB_RECURSE binaries \${CPACK_TEMPORARY_DIRECTORY}/*.a \${CPACK_TEMPORARY_DIRECTORY}/*.so
     \${CPACK_TEMPORARY_DIRECTORY}/*.so.* \${CPACK_TEMPORARY_DIRECTORY}/*/usr/bin/*)
foreach(binary IN LISTS binaries)
  if(IS_SYMLINK \${binary})
    continue()
  endif()
  execute_process(COMMAND ${ASDF_VK_STRIP} --strip-debug --enable-deterministic-archives --remove-section=.comment
                          --remove-section=.note \${binary} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
")
set(CPACK_PRE_BUILD_SCRIPTS ${folder}/strip.cmake)

foreach(component IN LISTS components)
  string(TOUPPER ${component} upper)
  install(FILES ${folder}/copyright ${folder}/changelog.gz ${folder}/NEWS.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME} COMPONENT ${component})
endforeach()
include(CPack)
