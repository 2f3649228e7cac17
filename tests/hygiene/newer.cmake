# The next minor version, NEWER, is another one: the package in ortung_DIR is looked at and refused.
find_package(ortung ${NEWER} QUIET)
if(ortung_FOUND OR NOT ortung_CONSIDERED_VERSIONS)
  message(FATAL_ERROR "asked for ${NEWER}: found '${ortung_FOUND}', looked at '${ortung_CONSIDERED_VERSIONS}'")
endif()
