# Packs the build tree BUILD_DIR as `cpack` does and uses what is in the packages from where they are
# unpacked. Of a build that is no package for others (PORTABLE is off) it must refuse to make one. Also:
# SOURCE_DIR, VERSION, READELF, CONFIG as BUILD_DIR has it, GENERATOR, CXX_COMPILER, and APP: whether it has
# the program.
foreach(name BUILD_DIR SOURCE_DIR VERSION READELF GENERATOR CXX_COMPILER)
  if(NOT ${name})
    message(FATAL_ERROR "${name} is not set")
  endif()
endforeach()
include(${CMAKE_CURRENT_LIST_DIR}/../search_paths.cmake)
set(work ${BUILD_DIR}/package-test)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work})

set(config)
if(CONFIG)
  set(config -C ${CONFIG})
endif()
get_filename_component(tools ${CMAKE_COMMAND} DIRECTORY)
include(${CMAKE_CURRENT_LIST_DIR}/../install_manifest.cmake)
set_manifests_aside()
execute_process(COMMAND ${tools}/cpack --config ${BUILD_DIR}/CPackConfig.cmake -B ${work} ${config}
                RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
put_manifests_back()
if(NOT PORTABLE)
  if(NOT failed OR NOT said MATCHES "`package`")
    message(FATAL_ERROR "packed for one machine, or refused for another reason:\n${said}")
  endif()
  return()
endif()
if(failed)
  message(FATAL_ERROR "cpack failed:\n${said}")
endif()

function(expect_files folder)
  foreach(file IN LISTS ARGN)
    file(GLOB found ${folder}/${file})
    if(NOT found)
      message(SEND_ERROR "not in ${folder}: ${file}")
    endif()
  endforeach()
endfunction()

# The program of an unpacked folder, which takes its scenes from there.
function(expect_program folder)
  execute_process(COMMAND ${folder}/bin/collisionStress --version
                  OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
  if(NOT version MATCHES "^collisionStress ${VERSION} ")
    message(SEND_ERROR "not version ${VERSION}: ${version}")
  endif()
  file(COPY_FILE ${folder}/share/quadrille/scenes/cradle.toml
       ${folder}/share/quadrille/scenes/of-the-package.toml)
  execute_process(COMMAND ${folder}/bin/collisionStress --headless of-the-package --frames 2
                  WORKING_DIRECTORY / OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  set(checked 0)
  check_search_paths(${folder}/bin/collisionStress)
  if(NOT checked EQUAL 1)
    message(SEND_ERROR "no program in ${folder}/bin")
  endif()
  file(STRINGS ${folder}/share/man/man1/collisionStress.1 manual REGEX "generate")
  file(STRINGS ${folder}/share/bash-completion/completions/collisionStress completion
       REGEX "--generate")
  if(NOT manual OR NOT completion)
    message(SEND_ERROR "manual or completion of ${folder} does not know --generate")
  endif()
endfunction()

set(development include/quadrille/quadrille.hpp lib*/*quadrille_core.*
    lib*/cmake/quadrille/quadrille-config.cmake lib*/cmake/quadrille/quadrille-config-version.cmake
    share/doc/libquadrille-dev/LICENSE)
set(program share/quadrille/scenes/balanced.toml share/doc/quadrille/LICENSE)

file(GLOB tarball ${work}/quadrille-${VERSION}-*.tar.gz)
file(ARCHIVE_EXTRACT INPUT "${tarball}" DESTINATION ${work}/tarball)
file(GLOB unpacked ${work}/tarball/*)
expect_files(${unpacked} ${development})
if(APP)
  expect_files(${unpacked} ${program})
  expect_program(${unpacked})
endif()

find_program(DPKG_DEB dpkg-deb)
if(said MATCHES "[.]deb generated")
  function(field package name pattern)
    execute_process(COMMAND ${DPKG_DEB} --field ${package} ${name}
                    OUTPUT_VARIABLE value COMMAND_ERROR_IS_FATAL ANY)
    if(NOT value MATCHES "${pattern}")
      message(SEND_ERROR "${name} of ${package} is ${value}")
    endif()
  endfunction()
  file(GLOB package ${work}/libquadrille-dev_${VERSION}_*.deb)
  field("${package}" Version "^${VERSION}")
  field("${package}" Depends "libeigen3-dev")
  execute_process(COMMAND ${DPKG_DEB} -x ${package} ${work}/development COMMAND_ERROR_IS_FATAL ANY)
  expect_files(${work}/development/usr ${development})
  if(APP)
    file(GLOB package ${work}/quadrille_${VERSION}_*.deb)
    field("${package}" Version "^${VERSION}")
    field("${package}" Depends "libstdc")
    execute_process(COMMAND ${DPKG_DEB} -x ${package} ${work}/program COMMAND_ERROR_IS_FATAL ANY)
    expect_files(${work}/program/usr ${program})
    expect_program(${work}/program/usr)
    if(EXISTS ${work}/program/usr/include OR EXISTS ${work}/development/usr/bin)
      message(SEND_ERROR "the two Debian packages have each other's files")
    endif()
  endif()
endif()

# What packages are built from is for any processor, whatever this build is.
execute_process(COMMAND ${CMAKE_COMMAND} --preset package -G ${GENERATOR} -B ${work}/preset
                        -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
                WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${work}/preset/compile_commands.json commands REGEX "\"command\"")
list(LENGTH commands count)
if(count LESS 50 OR commands MATCHES "-march|-mtune|-mcpu" OR NOT commands MATCHES "-O[23]")
  message(SEND_ERROR "the preset package compiles for one processor, or without optimising")
endif()
file(REMOVE_RECURSE ${work})
