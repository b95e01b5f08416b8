# Finds what the window needs; sets QUADRILLE_WINDOW_FOUND, and the target
# quadrille_window_libraries if all of it is there.
set(QUADRILLE_WINDOW_FOUND OFF)
find_package(SDL2 CONFIG QUIET)
find_path(EPOXY_INCLUDE_DIR epoxy/gl.h)
find_library(EPOXY_LIBRARY epoxy)
# Dear ImGui with its SDL2 and OpenGL 3 back ends compiled in, as Debian and vcpkg build it.
find_path(IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui)
find_library(IMGUI_LIBRARY imgui)
# Writes the screenshots; Debian's Dear ImGui is built on it, too.
find_path(STB_INCLUDE_DIR stb_image_write.h PATH_SUFFIXES stb)
find_library(STB_LIBRARY stb)
mark_as_advanced(EPOXY_INCLUDE_DIR EPOXY_LIBRARY IMGUI_INCLUDE_DIR IMGUI_LIBRARY STB_INCLUDE_DIR
                 STB_LIBRARY)

set(missing "")
foreach(part SDL2_FOUND EPOXY_INCLUDE_DIR EPOXY_LIBRARY IMGUI_INCLUDE_DIR IMGUI_LIBRARY
             STB_INCLUDE_DIR)
  if(NOT ${part})
    string(REGEX REPLACE "_.*" "" part ${part})
    list(APPEND missing ${part})
  endif()
endforeach()
if(missing)
  list(REMOVE_DUPLICATES missing)
  list(JOIN missing ", " missing)
  message(STATUS "collisionStress has no window: ${missing} not found")
  return()
endif()

add_library(quadrille_window_libraries INTERFACE)
target_include_directories(quadrille_window_libraries SYSTEM INTERFACE
  ${EPOXY_INCLUDE_DIR} ${IMGUI_INCLUDE_DIR} ${IMGUI_INCLUDE_DIR}/backends ${STB_INCLUDE_DIR})
# main() is the program's own; SDL must not rename it.
target_compile_definitions(quadrille_window_libraries INTERFACE SDL_MAIN_HANDLED)
target_link_libraries(quadrille_window_libraries INTERFACE
  ${IMGUI_LIBRARY} $<$<BOOL:${STB_LIBRARY}>:${STB_LIBRARY}> ${EPOXY_LIBRARY} SDL2::SDL2
  ${CMAKE_DL_LIBS})
set(QUADRILLE_WINDOW_FOUND ON)
