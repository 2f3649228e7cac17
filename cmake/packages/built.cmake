# Read by cpack when packages are made: each is packed again by dpkg-deb, which always makes the same bytes of the same
# files, and without the calls of ldconfig that cpack adds, for which Debian has a trigger.
find_program(DPKG_DEB dpkg-deb REQUIRED)
foreach(package IN LISTS CPACK_PACKAGE_FILES)
  set(folder ${CPACK_TEMPORARY_DIRECTORY}/again)
  file(REMOVE_RECURSE ${folder})
  execute_process(COMMAND ${DPKG_DEB} --raw-extract ${package} ${folder} COMMAND_ERROR_IS_FATAL ANY)
  foreach(script postinst postrm)
    if(EXISTS ${folder}/DEBIAN/${script})
      file(READ ${folder}/DEBIAN/${script} text)
      if(text MATCHES "ldconfig")
        file(REMOVE ${folder}/DEBIAN/${script})
        file(WRITE ${folder}/DEBIAN/triggers "activate-noawait ldconfig\n")
      endif()
    endif()
  endforeach()
  # Others of the group may write where umask says so; in a package they may not.
  execute_process(COMMAND chmod -R go-w ${folder} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${DPKG_DEB} --root-owner-group -Zxz --build ${folder} ${package}
                  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE ${folder})
endforeach()
