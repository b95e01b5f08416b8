# Installs the library, its headers, the scenes and the application, so that
# find_package(quadrille) gives quadrille::core. The component `program` is what runs scenes,
# `development` what programs are built with.
option(QUADRILLE_INSTALL "Add the rules that install Quadrille" ${PROJECT_IS_TOP_LEVEL})
if(NOT QUADRILLE_INSTALL)
  return()
endif()
include(CMakePackageConfigHelpers)

# Below 1.0 a minor version may change the binary interface.
set_target_properties(quadrille_core PROPERTIES
  VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  WINDOWS_EXPORT_ALL_SYMBOLS ON)

# A shared library is needed by either, and comes with the program.
install(TARGETS quadrille_core EXPORT quadrilleTargets
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program
                NAMELINK_COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/quadrille
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes
        DESTINATION ${CMAKE_INSTALL_DATADIR}/quadrille COMPONENT program
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/quadrille COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libquadrille-dev COMPONENT development)

if(TARGET collisionStress)
  # The program finds a shared library beside itself, wherever the prefix is moved to. In the build
  # tree it lies where it will once it is installed, so that no search path is edited afterwards:
  # CMake makes room for that with empty entries, and an empty entry is the current folder.
  file(RELATIVE_PATH lib_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  get_target_property(core_type quadrille_core TYPE)
  if(core_type STREQUAL SHARED_LIBRARY)
    get_property(multi GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
    set_target_properties(quadrille_core PROPERTIES LIBRARY_OUTPUT_DIRECTORY
      ${CMAKE_BINARY_DIR}/bin/$<$<BOOL:${multi}>:$<CONFIG>>/${lib_from_bin})
    set_target_properties(collisionStress PROPERTIES
      INSTALL_RPATH $<IF:$<PLATFORM_ID:Darwin>,@loader_path,$ORIGIN>/${lib_from_bin})
  endif()
  set_target_properties(collisionStress PROPERTIES
    BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH_USE_LINK_PATH ON)
  install(TARGETS collisionStress EXPORT quadrilleProgram
          RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)

  # The program knows its options; one for another machine cannot be asked here.
  if(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
    set(manual ${PROJECT_BINARY_DIR}/man/collisionStress.1)
    set(completion ${PROJECT_BINARY_DIR}/bash-completion/collisionStress)
    file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/man ${PROJECT_BINARY_DIR}/bash-completion)
    add_custom_command(OUTPUT ${manual} ${completion} DEPENDS collisionStress VERBATIM
      COMMAND collisionStress --generate man > ${manual}
      COMMAND collisionStress --generate complete-bash > ${completion})
    add_custom_target(quadrille_option_lists ALL DEPENDS ${manual} ${completion})
    install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
    install(FILES ${completion} COMPONENT program
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  endif()
endif()

# Who links a static library links its private libraries too, so they must be found again.
get_target_property(core_type quadrille_core TYPE)
get_target_property(core_libraries quadrille_core LINK_LIBRARIES)
set(QUADRILLE_PRIVATE_DEPENDENCIES "")
if(core_type STREQUAL STATIC_LIBRARY)
  if(core_libraries MATCHES "Threads::Threads")
    string(APPEND QUADRILLE_PRIVATE_DEPENDENCIES "find_dependency(Threads)\n")
  endif()
endif()

if(TARGET quadrille_cuda)
  install(TARGETS quadrille_cuda EXPORT quadrilleTargets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  if(core_type STREQUAL STATIC_LIBRARY)
    string(APPEND QUADRILLE_PRIVATE_DEPENDENCIES "find_dependency(CUDAToolkit)\n")
  endif()
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/quadrille)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/quadrille-config.cmake.in
  ${PROJECT_BINARY_DIR}/quadrille-config.cmake INSTALL_DESTINATION ${package_dir}
  PATH_VARS CMAKE_INSTALL_BINDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/quadrille-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(EXPORT quadrilleTargets NAMESPACE quadrille:: DESTINATION ${package_dir}
        COMPONENT development)
if(TARGET collisionStress)
  install(EXPORT quadrilleProgram NAMESPACE quadrille:: DESTINATION ${package_dir}
          COMPONENT development)
endif()
install(FILES ${PROJECT_BINARY_DIR}/quadrille-config.cmake
              ${PROJECT_BINARY_DIR}/quadrille-config-version.cmake
        DESTINATION ${package_dir} COMPONENT development)

if(PROJECT_IS_TOP_LEVEL)
  add_custom_target(uninstall VERBATIM
    COMMAND ${CMAKE_COMMAND} -DBUILD_DIR=${PROJECT_BINARY_DIR}
            -P ${PROJECT_SOURCE_DIR}/cmake/uninstall.cmake)
  include(QuadrillePackages)
endif()
