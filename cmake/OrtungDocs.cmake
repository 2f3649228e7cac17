# The documentation's site: `cmake --build BUILD --target docs-site` makes BUILD/docs-site/html. scripts/install-deps.sh installs
# what it needs of Debian. With ORTUNG_DOCS it is made with everything else, and there is a package of it. What it is made of is
# for docs/site/build.py to know, which does nothing if none of it has changed.
function(ortung_docs_site)
  if(ORTUNG_DOCS)
    set(all ALL)
  endif()
  if(TARGET ortung_python)
    set(package --python ${PROJECT_BINARY_DIR}/lib/python)
  endif()
  add_custom_target(docs-site ${all}
    COMMAND /usr/bin/python3 -B ${PROJECT_SOURCE_DIR}/docs/site/build.py ${PROJECT_BINARY_DIR}/docs-site
            --program $<TARGET_FILE:ortung> --version ${PROJECT_VERSION} ${package}
    VERBATIM)
  # The program is asked for all keys, which it asks its plugins for.
  add_dependencies(docs-site ortung ortung_commands ortung_plugins)
  if(TARGET ortung_python)
    add_dependencies(docs-site ortung_python ortung_python_learning ortung_python_sim)
  endif()
endfunction()
