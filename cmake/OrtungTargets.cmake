# One way to make a library, one way to make a plugin. Folders use nothing else.
include(${CMAKE_CURRENT_LIST_DIR}/OrtungAbi.cmake)

if(PROJECT_IS_TOP_LEVEL)
  find_program(ORTUNG_CCACHE ccache)
  if(ORTUNG_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # Without this it does not keep what was compiled with a precompiled header, whose macros it can't see.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${ORTUNG_CCACHE})
  endif()
endif()
# In the variables of this project alone; a parent keeps its own.
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
# Libraries are shared unless BUILD_SHARED_LIBS says otherwise. Static ones are part of programs and of plugins,
# each of which then has its own.
if(DEFINED BUILD_SHARED_LIBS AND NOT BUILD_SHARED_LIBS)
  set(ORTUNG_SHARED OFF)
  set(ORTUNG_LIBRARY_KIND STATIC)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
else()
  set(ORTUNG_SHARED ON)
  set(ORTUNG_LIBRARY_KIND SHARED)
endif()
# What a version promises: before 1.0 each minor one is new, for who links as for who compiles.
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(ORTUNG_SOVERSION 0.${PROJECT_VERSION_MINOR})
  set(ORTUNG_COMPATIBILITY SameMinorVersion)
else()
  set(ORTUNG_SOVERSION ${PROJECT_VERSION_MAJOR})
  set(ORTUNG_COMPATIBILITY SameMajorVersion)
endif()

# Warnings, and no fused multiply-add: the same bits whatever instruction set is chosen at run time.
function(ortung_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -ffp-contract=off)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
    target_compile_options(${target} PRIVATE -U__ARM_FEATURE_FMA)  # by which Eigen fuses them, too
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)  # warns of "text" + std::to_string(n)
  endif()
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden
                        VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# ortung_precompiled(tests HEADERS <gtest/gtest.h> <vector> LINK GTest::gtest [OPTIONS -O0] [PIC])
# Makes a target whose headers are parsed once; ortung_reuse_precompiled(TARGET tests) includes them in all sources of a
# target with the same options. A source still includes what it uses itself.
function(ortung_precompiled name)
  cmake_parse_arguments(ARG "PIC" "" "HEADERS;LINK;OPTIONS" ${ARGN})
  set(target ortung_precompiled_${name})
  file(CONFIGURE OUTPUT ${target}.cpp CONTENT "")
  add_library(${target} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  ortung_options(${target})
  target_compile_options(${target} PRIVATE ${ARG_OPTIONS})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # for ccache
  endif()
  target_link_libraries(${target} PRIVATE ${ARG_LINK})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ${ARG_PIC})
  target_precompile_headers(${target} PRIVATE ${ARG_HEADERS})
endfunction()
function(ortung_reuse_precompiled target name)
  target_precompile_headers(${target} REUSE_FROM ortung_precompiled_${name})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)
  endif()
endfunction()

# ortung_library(sim SOURCES src/a.cpp HEADERS include/ortung/sim/a.hpp PUBLIC Eigen3::Eigen PRIVATE x)
# Makes libortung_sim.so (or .a), the target ortung::sim and its install rules. Public headers lie in folders
# named include/, private ones beside the sources, which see them all.
function(ortung_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  set(target ortung_${name})
  add_library(${target} ${ORTUNG_LIBRARY_KIND} ${ARG_SOURCES})
  add_library(ortung::${name} ALIAS ${target})
  list(TRANSFORM ARG_HEADERS REPLACE "/?include/.*" "/include" OUTPUT_VARIABLE include_folders)
  list(TRANSFORM include_folders REPLACE "^/" "")
  list(REMOVE_DUPLICATES include_folders)
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${include_folders} FILES ${ARG_HEADERS})
  list(TRANSFORM ARG_SOURCES REPLACE "/[^/]*$" "" OUTPUT_VARIABLE source_folders)
  list(REMOVE_DUPLICATES source_folders)
  target_include_directories(${target} PRIVATE ${source_folders})
  # Libraries of headers end where ours begins: nobody who links it needs them.
  set(private ${ARG_PRIVATE})
  list(TRANSFORM private REPLACE "^(Eigen3::Eigen|nlohmann_json::nlohmann_json|Boost::headers)$" "$<BUILD_INTERFACE:\\1>")
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${private})
  ortung_options(${target})
  ortung_abi_tag(${name} ${ARG_HEADERS})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${ORTUNG_SOVERSION}
    INSTALL_RPATH $ORIGIN
    VERIFY_INTERFACE_HEADER_SETS ON) # every public header compiles alone
  if(NOT ORTUNG_INSTALL)
    return()
  endif()
  list(FILTER private EXCLUDE REGEX "BUILD_INTERFACE")
  ortung_component(${name} "${ARG_PUBLIC}" "${private}")
  ortung_pkg_config(${name} "${ARG_PUBLIC}" "${private}")
  ortung_package_of(${target} package)
  ortung_development_of(${package} development)
  install(TARGETS ${target} EXPORT ortung_${name}
    LIBRARY COMPONENT ${package} NAMELINK_COMPONENT ${development}
    ARCHIVE COMPONENT ${development}
    FILE_SET HEADERS COMPONENT ${development} FILE_SET abi COMPONENT ${development})
  install(EXPORT ortung_${name} NAMESPACE ortung:: FILE ortung_${name}.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/ortung COMPONENT ${development})
  install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/ortung-${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT ${development})
endfunction()

# Notes for the package what the component is built on: our libraries, which must be loaded before it, and
# packages of others whose targets its users link. The package loads components in the order of these notes,
# which is that of their dependencies.
function(ortung_component name public private)
  set(needs ${public} ${private})
  list(FILTER needs INCLUDE REGEX "^ortung::")
  list(TRANSFORM needs REPLACE "^ortung::" "")
  set(packages ${public})
  if(NOT ORTUNG_SHARED)  # whoever links it links all that it is built on
    list(APPEND packages ${private})
  endif()
  list(FILTER packages EXCLUDE REGEX "^(ortung::|-l|opencv_)")
  list(TRANSFORM packages REPLACE "^Boost::(.*)" "Boost,COMPONENTS,\\1")
  list(TRANSFORM packages REPLACE "::.*" "")  # a target's package is what stands before its name
  set_property(GLOBAL APPEND PROPERTY ORTUNG_COMPONENTS ${name})
  set_property(GLOBAL APPEND_STRING PROPERTY ORTUNG_COMPONENT_NOTES
    "set(ortung_${name}_NEEDS ${needs})\nset(ortung_${name}_PACKAGES ${packages})\n")
endfunction()

# Makes ortung-NAME.pc, which finds the rest from where it lies.
function(ortung_pkg_config name public private)
  set(folder ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig)
  file(RELATIVE_PATH prefix ${folder} ${CMAKE_INSTALL_PREFIX})
  file(RELATIVE_PATH libdir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR})
  file(RELATIVE_PATH includedir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
  set(needs ${public})
  set(private_needs ${private})
  foreach(list needs private_needs)
    list(FILTER ${list} INCLUDE REGEX "^ortung::")
    list(TRANSFORM ${list} REPLACE "^ortung::" "ortung-")
    list(JOIN ${list} ", " ${list})
  endforeach()
  set(libraries ${private})  # of others, for static linking
  list(FILTER libraries EXCLUDE REGEX "^ortung::")
  list(TRANSFORM libraries REPLACE "^Threads::Threads$" "-pthread")
  list(TRANSFORM libraries REPLACE "^Boost::" "boost_")
  list(TRANSFORM libraries REPLACE "^embree$" "embree3")
  list(TRANSFORM libraries REPLACE "^zstd::.*" "zstd")
  list(TRANSFORM libraries REPLACE "^.*::" "")
  list(TRANSFORM libraries PREPEND "-l" REGEX "^[^-]")
  list(JOIN libraries " " libraries)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/ortung.pc.in ${PROJECT_BINARY_DIR}/pkgconfig/ortung-${name}.pc @ONLY)
endfunction()

# ortung_plugin(lrf_data SOURCES x.cpp LINK ortung::container [PLUGINS other_plugin])
# Makes lib/ortung/plugins/ortung_lrf_data.so, a module nobody links. The file's name begins with
# the plugin's own, by which the factory finds it first. PLUGINS are those that it asks for by name itself.
function(ortung_plugin name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PLUGINS" ${ARGN})
  set_property(GLOBAL PROPERTY ORTUNG_PLUGINS_OF_${name} ${ARG_PLUGINS})
  add_library(ortung_${name} MODULE ${ARG_SOURCES})
  target_link_libraries(ortung_${name} PRIVATE ${ARG_LINK})
  ortung_options(ortung_${name})
  set_target_properties(ortung_${name} PROPERTIES PREFIX ""
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/ortung/plugins
    INSTALL_RPATH $ORIGIN/../..)
  set_property(GLOBAL APPEND PROPERTY ORTUNG_PLUGIN_TARGETS ortung_${name})
  if(ORTUNG_INSTALL)
    ortung_package_of(ortung_${name} package)
    install(TARGETS ortung_${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/ortung/plugins COMPONENT ${package})
  endif()
endfunction()

# Installs a program, which finds our libraries from where it lies.
function(ortung_install_program target folder)
  if(NOT ORTUNG_INSTALL)
    return()
  endif()
  GNUInstallDirs_get_absolute_install_dir(full folder BINDIR)
  file(RELATIVE_PATH libraries ${full} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(${target} PROPERTIES INSTALL_RPATH $ORIGIN/${libraries})
  ortung_package_of(${target} package)
  install(TARGETS ${target} RUNTIME DESTINATION ${folder} COMPONENT ${package})
endfunction()

function(ortung_install_package)
  include(CMakePackageConfigHelpers)
  get_property(components GLOBAL PROPERTY ORTUNG_COMPONENTS)
  get_property(notes GLOBAL PROPERTY ORTUNG_COMPONENT_NOTES)
  write_basic_package_version_file(ortungConfigVersion.cmake COMPATIBILITY ${ORTUNG_COMPATIBILITY})
  configure_package_config_file(cmake/ortungConfig.cmake.in ortungConfig.cmake
    INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/ortung)
  install(FILES ${PROJECT_BINARY_DIR}/ortungConfig.cmake ${PROJECT_BINARY_DIR}/ortungConfigVersion.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/ortung COMPONENT libortung-dev)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
endfunction()
