# `cpack` makes of what is installed a tarball and, where dpkg is, Debian packages: `quadrille` with the
# program, `libquadrille-dev` with the library.
if(QUADRILLE_NATIVE OR QUADRILLE_SANITIZE OR BUILD_SHARED_LIBS)
  file(WRITE ${PROJECT_BINARY_DIR}/CPackConfig.cmake "message(FATAL_ERROR \"\
This build is no package for others: it is for this processor only, has sanitizers, or a shared library. \
Build the preset `package`.\")\n")
  return()
endif()

set(CPACK_PACKAGE_VENDOR "The Quadrille developers")
set(CPACK_PACKAGE_CONTACT ${CPACK_PACKAGE_VENDOR})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
string(TOLOWER quadrille-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}
       CPACK_PACKAGE_FILE_NAME)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL development)
if(TARGET collisionStress)
  list(APPEND CPACK_COMPONENTS_ALL program)
endif()

set(CPACK_GENERATOR TGZ)
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
mark_as_advanced(DPKG_SHLIBDEPS)
if(DPKG_SHLIBDEPS)
  list(APPEND CPACK_GENERATOR DEB)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME quadrille)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "The program collisionStress and its scenes.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libquadrille-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.3)")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "The library, its headers and its CMake package.")
include(CPack)
