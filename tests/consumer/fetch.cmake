# Configures the project SOURCE_DIR with the source tree ROOT as a part of it (FetchContent), in a folder of
# BUILD_DIR, and compiles its program; the library is compiled by other tests. Also: CXX_COMPILER, EIGEN3_DIR.
foreach(name BUILD_DIR SOURCE_DIR ROOT CXX_COMPILER)
  if(NOT ${name})
    message(FATAL_ERROR "${name} is not set")
  endif()
endforeach()
set(work ${BUILD_DIR}/fetch-test)
file(REMOVE_RECURSE ${work})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${work} -G Ninja
                        -DQUADRILLE_SOURCE=${ROOT} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
                        -DEigen3_DIR=${EIGEN3_DIR}
                COMMAND_ERROR_IS_FATAL ANY)
# A guest brings no programs and tests, and installs nothing.
file(STRINGS ${work}/build.ninja own REGEX "^build ([a-zA-Z_]*test[a-z_]*|collisionStress|uninstall):")
if(own)
  message(FATAL_ERROR "targets that a guest should not have: ${own}")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} --build ${work} --target CMakeFiles/consumer.dir/main.cpp.o
                COMMAND_ERROR_IS_FATAL ANY)
