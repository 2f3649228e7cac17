# Which public headers a library or a plugin was built with.

# ortung_abi_hash(OUT FILES...)  eight letters that change with what headers declare. Neither comments nor layout count, so better
# words in a docstring neither refuse plugins nor compile everything anew.
function(ortung_abi_hash out)
  foreach(header IN LISTS ARGN)
    file(READ ${header} text)
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REGEX REPLACE "[ \t\r\n]" "" text "${text}")
    string(SHA256 hash "${text}")
    string(APPEND all ${hash})
  endforeach()
  string(SHA256 all "${all}")
  string(SUBSTRING ${all} 0 8 all)
  set(${out} ${all} PARENT_SCOPE)
endfunction()

# Writes <ortung/NAME/Abi.hpp>: a fingerprint of the public headers. It is part of every
# interface name, so a plugin built from other headers is refused without anybody
# having to remember a version number.
function(ortung_abi_tag name)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE headers)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${headers})
  ortung_abi_hash(tag ${headers})
  string(TOUPPER ${name} upper)
  set(dir ${CMAKE_CURRENT_BINARY_DIR}/include)
  file(CONFIGURE OUTPUT ${dir}/ortung/${name}/Abi.hpp @ONLY
    CONTENT "#pragma once\n#define ORTUNG_@upper@_ABI \"@PROJECT_VERSION@-@tag@\"\n")
  target_sources(ortung_${name} PUBLIC FILE_SET abi TYPE HEADERS BASE_DIRS ${dir}
                 FILES ${dir}/ortung/${name}/Abi.hpp)
endfunction()
