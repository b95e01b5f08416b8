# A program that looks for libraries in the current folder runs what a stranger put there. Fails if
# a search path of a built program (the file PROGRAMS lists them), or of one that the build tree
# BUILD_DIR installs, has an entry that is empty or relative to anything but the program itself.
# Also: READELF, and CONFIG as BUILD_DIR has it.
foreach(name READELF PROGRAMS BUILD_DIR)
  if(NOT ${name})
    message(FATAL_ERROR "${name} is not set")
  endif()
endforeach()

include(${CMAKE_CURRENT_LIST_DIR}/search_paths.cmake)

# A build of some targets only has not all of them.
set(checked 0)
file(STRINGS ${PROGRAMS} programs)
foreach(program IN LISTS programs)
  if(EXISTS ${program})
    check_search_paths(${program})
  endif()
endforeach()
if(checked EQUAL 0)
  message(FATAL_ERROR "none of the programs is built")
endif()
message(STATUS "${checked} programs and libraries in the build tree")

set(config)
if(CONFIG)
  set(config --config ${CONFIG})
endif()
set(prefix ${BUILD_DIR}/library-search-paths-test)
file(REMOVE_RECURSE ${prefix})
unset(ENV{DESTDIR})
include(${CMAKE_CURRENT_LIST_DIR}/install_manifest.cmake)
set_manifests_aside()
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} ${config}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
put_manifests_back()
set(checked 0)
file(GLOB_RECURSE installed ${prefix}/*)
foreach(file IN LISTS installed)
  check_search_paths(${file})
endforeach()
if(checked EQUAL 0)
  message(FATAL_ERROR "no program was installed")
endif()
message(STATUS "${checked} programs and libraries in the installed tree")
file(REMOVE_RECURSE ${prefix})
