# Read by cpack before it packs: the time that all files get, and the changelogs. What depends on the last commit is
# made here, since nobody configures again after a commit.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C ${CPACK_ORTUNG_SOURCE_DIR} log -1 --format=%ct
                  OUTPUT_VARIABLE epoch OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT epoch)  # sources without their history
    file(TIMESTAMP ${CPACK_ORTUNG_SOURCE_DIR}/CHANGELOG.md epoch "%s" UTC)
  endif()
  set(ENV{SOURCE_DATE_EPOCH} ${epoch})
endif()

set(folder ${CPACK_ORTUNG_BINARY_DIR}/packages)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
file(WRITE ${folder}/changelog.Debian
  "ortung (${version}) unstable; urgency=medium\n\n  * Built from Ortung's own sources by cpack.\n\n"
  " -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}\n")
configure_file(${CPACK_ORTUNG_SOURCE_DIR}/CHANGELOG.md ${folder}/changelog COPYONLY)
execute_process(COMMAND gzip -9nf ${folder}/changelog.Debian ${folder}/changelog COMMAND_ERROR_IS_FATAL ANY)

# Plugins are no libraries to link, so they have no version; cpack would tell about each.
set(CMAKE_SUPPRESS_DEVELOPER_WARNINGS TRUE CACHE INTERNAL "")
