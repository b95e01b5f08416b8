# Headers that nearly every source includes are parsed once and not for each. A source still includes
# what it uses: CMAKE_DISABLE_PRECOMPILE_HEADERS=ON shows who does not.
set(QUADRILLE_COMMON_HEADERS
  <algorithm> <array> <cmath> <cstdint> <functional> <memory> <string> <vector>
  <quadrille/simulation.hpp>)

# Targets of sources that are compiled alike share what one target made, which has no other source.
function(quadrille_precompiled_headers target)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Its headers are the matter.\n")
  add_library(${target} OBJECT ${source})
  target_link_libraries(${target} PRIVATE quadrille::core quadrille_compiler)
  target_precompile_headers(${target} PRIVATE ${ARGN})
endfunction()
