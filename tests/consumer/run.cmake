# Installs the build tree BUILD_DIR into a prefix of its own, configures, builds and runs the project
# SOURCE_DIR against that, then uninstalls. Also: whether there are the components APP and CUDA, CXX_COMPILER, GENERATOR, CONFIG, EIGEN3_DIR, CXX_FLAGS and
# SANITIZE (a list as in -fsanitize=) as BUILD_DIR has them.
foreach(name BUILD_DIR SOURCE_DIR CXX_COMPILER GENERATOR)
  if(NOT ${name})
    message(FATAL_ERROR "${name} is not set")
  endif()
endforeach()
set(work ${BUILD_DIR}/consumer-test)
set(prefix ${work}/prefix)

# What an earlier run left must not stand in for what this one fails to install.
file(REMOVE_RECURSE ${work})
unset(ENV{DESTDIR})

set(config)
if(CONFIG)
  set(config --config ${CONFIG})
endif()
if(SANITIZE)
  # A static library brings no link options of its sanitizers; its user gives them.
  string(APPEND CXX_FLAGS " -fsanitize=${SANITIZE}")
endif()

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "ended with: ${result}")
  endif()
endfunction()

include(${CMAKE_CURRENT_LIST_DIR}/../install_manifest.cmake)
set_manifests_aside()
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} ${config})
set(options -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_CXX_FLAGS=${CXX_FLAGS}
    -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_PREFIX_PATH=${prefix} -DEigen3_DIR=${EIGEN3_DIR})
# $<1:...> keeps a multi-configuration generator from appending the configuration.
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${work}/build ${options}
    -DCMAKE_RUNTIME_OUTPUT_DIRECTORY=$<1:${work}/bin>)
# Another Quadrille on this machine must not be what was tested.
file(STRINGS ${work}/build/CMakeCache.txt found REGEX "^quadrille_DIR:")
string(FIND "${found}" "=${prefix}/" in_prefix)
if(in_prefix EQUAL -1)
  message(FATAL_ERROR "not the package just installed: ${found}")
endif()
run(${CMAKE_COMMAND} --build ${work}/build ${config})
run(${work}/bin/consumer)
run(${CMAKE_COMMAND} -S ${SOURCE_DIR}/components -B ${work}/components ${options}
    -DPROGRAM=${APP} -DCUDA=${CUDA})

# What somebody else put there stays.
file(WRITE ${prefix}/share/quadrille/.mine "")
run(${CMAKE_COMMAND} --build ${BUILD_DIR} --target uninstall ${config})
file(GLOB_RECURSE rest RELATIVE ${prefix} ${prefix}/* ${prefix}/.*)
if(NOT rest STREQUAL "share/quadrille/.mine")
  message(FATAL_ERROR "uninstalling left: ${rest}")
endif()
if(EXISTS ${prefix}/include/quadrille)
  message(FATAL_ERROR "uninstalling left include/quadrille")
endif()
put_manifests_back()
