# Commands of the program `ortung`. Each is a module that the program opens when somebody asks for it, so that one
# command's libraries are no concern of the others. What is declared here is in the program's catalogue, built or not:
# the program says which package has a command that is not installed.

# ortung_command_group(export "Turn what is Ortung's into files of others" "ortung export rawlog ...")
# What commands with the same first word have in common, and an example.
function(ortung_command_group name summary example)
  set_property(GLOBAL APPEND_STRING PROPERTY ORTUNG_CATALOGUE_GROUPS "{\"${name}\", \"${summary}\", \"${example}\"},\n")
endfunction()

# ortung_command_section("Localize")  the heading of the commands that follow in `ortung --help`
function(ortung_command_section heading)
  set_property(GLOBAL PROPERTY ORTUNG_COMMAND_SECTION "${heading}")
endfunction()

# ortung_command(learn PACKAGE ortung-sim
#   COMMANDS learn "Learn what a robot's sensors read all over a world" [further names and summaries]
#   SOURCES learn/LearnOptions.cpp learn/Learn.cpp LINK app_options ortung::sim [PLUGINS learner_player])
# Makes lib/ortung/commands/ortung_command_learn.so, if all that it links is built.
# PLUGINS are those that it asks for by name, whatever robot it is for.
function(ortung_command name)
  cmake_parse_arguments(ARG "" "PACKAGE" "COMMANDS;SOURCES;LINK;PLUGINS" ${ARGN})
  set(rest ${ARG_COMMANDS})
  get_property(section GLOBAL PROPERTY ORTUNG_COMMAND_SECTION)
  while(rest)
    list(POP_FRONT rest command summary)
    if(NOT summary)
      message(FATAL_ERROR "ortung_command(${name}): '${command}' has no summary")
    endif()
    set_property(GLOBAL APPEND_STRING PROPERTY ORTUNG_CATALOGUE_COMMANDS
                 "{\"${command}\", \"${summary}\", \"${name}\", \"${ARG_PACKAGE}\", \"${section}\"},\n")
  endwhile()
  set_property(GLOBAL PROPERTY ORTUNG_PLUGINS_OF_command_${name} ${ARG_PLUGINS})
  foreach(library IN LISTS ARG_LINK)
    if(NOT TARGET ${library})
      message(STATUS "The command ${name} is left out: ${library} is not built")
      return()
    endif()
  endforeach()
  set(target ortung_command_${name})
  add_library(${target} MODULE ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE ${ARG_LINK})
  target_link_options(${target} PRIVATE -Wl,--as-needed)  # what a part links that this command does without
  ortung_options(${target})
  set_target_properties(${target} PROPERTIES PREFIX ""
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/ortung/commands
    INSTALL_RPATH $ORIGIN/../..)
  set_property(GLOBAL APPEND PROPERTY ORTUNG_COMMAND_TARGETS ${target})
  if(ORTUNG_INSTALL)
    ortung_package_of(${target} package)
    if(NOT package STREQUAL ARG_PACKAGE)
      message(FATAL_ERROR "The command ${name} is said to be in ${ARG_PACKAGE}, but what it links is in ${package}")
    endif()
    install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/ortung/commands COMPONENT ${package})
  endif()
endfunction()

# ortung_write_catalogue(FOLDER)  writes what was declared, for Catalogue.cpp.
function(ortung_write_catalogue folder)
  foreach(list COMMANDS GROUPS)
    get_property(text GLOBAL PROPERTY ORTUNG_CATALOGUE_${list})
    string(SUBSTRING ${list} 1 -1 rest)
    string(TOLOWER ${rest} rest)
    string(SUBSTRING ${list} 0 1 first)
    file(CONFIGURE OUTPUT ${folder}/Catalogue${first}${rest}.inc CONTENT "${text}" @ONLY)
  endforeach()
endfunction()
