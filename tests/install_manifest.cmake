# What somebody has installed from BUILD_DIR is what `uninstall` goes by: the lists of it are set aside while a
# test installs, too, and put back afterwards. After a test that failed, the next one puts them back.
set(manifests_aside ${BUILD_DIR}/manifests-aside)

# Moves the lists that are in one folder to another one.
function(move_manifests from to)
  file(GLOB lists ${from}/install_manifest*.txt)
  foreach(list IN LISTS lists)
    get_filename_component(name ${list} NAME)
    file(RENAME ${list} ${to}/${name})
  endforeach()
endfunction()

function(remove_manifests)
  file(GLOB lists ${BUILD_DIR}/install_manifest*.txt)
  foreach(list IN LISTS lists)
    file(REMOVE ${list})
  endforeach()
endfunction()

function(set_manifests_aside)
  if(EXISTS ${manifests_aside})
    remove_manifests()  # of a test that failed
    return()
  endif()
  file(MAKE_DIRECTORY ${manifests_aside})
  move_manifests(${BUILD_DIR} ${manifests_aside})
endfunction()

function(put_manifests_back)
  remove_manifests()
  move_manifests(${manifests_aside} ${BUILD_DIR})
  file(REMOVE_RECURSE ${manifests_aside})
endfunction()
