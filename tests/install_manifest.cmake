# What somebody has installed from BUILD_DIR is what `uninstall` goes by: the lists of it are set aside while a
# test installs, too, and put back afterwards. After a test that failed, the next one puts them back.
set(manifests_aside ${BUILD_DIR}/manifests-aside)

function(set_manifests_aside)
  file(GLOB lists ${BUILD_DIR}/install_manifest*.txt)
  if(EXISTS ${manifests_aside})
    file(REMOVE ${lists})  # of a test that failed
    return()
  endif()
  file(MAKE_DIRECTORY ${manifests_aside})
  foreach(list IN LISTS lists)
    get_filename_component(name ${list} NAME)
    file(RENAME ${list} ${manifests_aside}/${name})
  endforeach()
endfunction()

function(put_manifests_back)
  file(GLOB lists ${BUILD_DIR}/install_manifest*.txt)
  file(REMOVE ${lists})
  file(GLOB lists ${manifests_aside}/*)
  foreach(list IN LISTS lists)
    get_filename_component(name ${list} NAME)
    file(RENAME ${list} ${BUILD_DIR}/${name})
  endforeach()
  file(REMOVE_RECURSE ${manifests_aside})
endfunction()
