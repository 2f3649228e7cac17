# What a wheel holds, as the component `wheel` that nothing but backend.py installs: the package with all
# libraries, plugins and maps below it, wherever it comes to lie.

# All of Ortung's libraries that TARGET links.
function(ortung_libraries_of target result)
  set(found ${${result}})
  get_target_property(links ${target} LINK_LIBRARIES)
  foreach(link IN LISTS links)
    if(NOT link MATCHES "^ortung::")
      continue()
    endif()
    get_target_property(library ${link} ALIASED_TARGET)
    if(library AND NOT library IN_LIST found)
      list(APPEND found ${library})
      ortung_libraries_of(${library} found)
    endif()
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

get_property(plugins GLOBAL PROPERTY ORTUNG_PLUGIN_TARGETS)
set(libraries "")
foreach(target IN LISTS plugins targets)
  ortung_libraries_of(${target} libraries)
endforeach()
add_custom_target(ortung_wheel DEPENDS ${targets} ${plugins} ${libraries})

set(for_wheel COMPONENT wheel EXCLUDE_FROM_ALL)
install(TARGETS ${targets} LIBRARY DESTINATION ortung ${for_wheel})
install(FILES ${modules} DESTINATION ortung ${for_wheel})
install(TARGETS ${libraries} LIBRARY DESTINATION ortung/lib NAMELINK_SKIP ${for_wheel})
install(TARGETS ${plugins} LIBRARY DESTINATION ortung/lib/ortung/plugins ${for_wheel})
foreach(folder fields robots rules scenes)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/maps/${folder} DESTINATION ortung/share/ortung/maps ${for_wheel}
          FILES_MATCHING PATTERN "*.toml")
endforeach()
