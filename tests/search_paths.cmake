# check_search_paths(FILE): fails if the program or library FILE looks for libraries in a folder that is
# empty or relative to anything but itself, and adds 1 to the variable `checked`; leaves other files. READELF
# is the program of that name.
function(check_search_paths program)
  file(READ ${program} magic LIMIT 4 HEX)
  if(NOT magic STREQUAL 7f454c46)
    return()
  endif()
  execute_process(COMMAND ${READELF} --dynamic --wide ${program} OUTPUT_VARIABLE dynamic
                  COMMAND_ERROR_IS_FATAL ANY)
  math(EXPR count "${checked} + 1")
  set(checked ${count} PARENT_SCOPE)
  string(REGEX MATCHALL "\\((RPATH|RUNPATH)\\)[^\n]*" lines "${dynamic}")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^[^[]*\\[(.*)\\].*$" "\\1" path "${line}")
    if(NOT ":${path}:" MATCHES "^:(([$]ORIGIN|[$]{ORIGIN}|/)[^:]*:)+$")
      message(SEND_ERROR "${program} looks for libraries in '${path}'")
    endif()
  endforeach()
endfunction()
