# Debian packages: which one a target belongs to, and what cpack makes of them. A package is a component of the
# install rules of the same name, so that `cmake --install BUILD --component libortung0` works, too.

# ortung_package_of(ortung_lrf_data package)  sets package to the one that the target belongs to. What the target is
# built on decides, through all our targets, so nobody keeps a list:
#   python3-ortung   the Python module
#   ortung-ros2      whatever talks DDS
#   ortung-devices   whatever needs OpenCV, MRPT or devices of a robot
#   ortung-sim       whatever needs the simulator, or serves it
#   libortung0       libraries that need the standard library alone
#   libortung-run0   other libraries
#   ortung           programs and plugins
function(ortung_package_of target out)
  set_property(GLOBAL APPEND PROPERTY ORTUNG_PACKAGED ${target})
  ortung_needs(${target} needs)
  get_target_property(type ${target} TYPE)
  set(foreign ${needs})
  # Threads are the standard library's; what is for the build alone are headers.
  list(FILTER foreign EXCLUDE REGEX "^(ortung_.*|${target}|Threads::Threads|\\$<BUILD_INTERFACE:.*)$")
  if(needs MATCHES "(^|;)pybind11::")
    set(package python3-ortung)
  elseif(needs MATCHES "(^|;)fastrtps(;|$)")
    set(package ortung-ros2)
  elseif(needs MATCHES "(^|;)(opencv_|mrpt::|ortung_devices(;|$))")
    set(package ortung-devices)
  elseif(needs MATCHES "(^|;)ortung_(sim_api|server|web)(;|$)")
    set(package ortung-sim)
  elseif(type STREQUAL "SHARED_LIBRARY" AND NOT foreign)
    set(package libortung0)
  elseif(type MATCHES "^(SHARED|STATIC)_LIBRARY$")
    set(package libortung-run0)
  else()
    set(package ortung)
  endif()
  set(${out} ${package} PARENT_SCOPE)
endfunction()

# The package of what one needs to compile for a library: headers, links, files for CMake and pkg-config.
function(ortung_development_of package out)
  string(REGEX REPLACE "^ortung-(.*)" "libortung-\\1-dev" development ${package})
  string(REGEX REPLACE "^libortung(-run)?0$" "libortung-dev" development ${development})
  set(${out} ${development} PARENT_SCOPE)
endfunction()

# All that a target is built on, itself included. Others' targets are named as they were linked.
function(ortung_needs target out)
  set(open ${target})
  set(found "")
  while(open)
    list(POP_FRONT open next)
    if(TARGET "${next}")
      get_target_property(real ${next} ALIASED_TARGET)
      if(real)
        set(next ${real})
      endif()
    endif()
    if(next IN_LIST found)
      continue()
    endif()
    list(APPEND found ${next})
    if(TARGET "${next}")
      get_target_property(imported ${next} IMPORTED)
      get_target_property(links ${next} LINK_LIBRARIES)
      if(NOT imported AND links)
        list(APPEND open ${links})
      endif()
    endif()
  endwhile()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# What packages need of each other, by what their targets are built on: ORTUNG_NEEDS_<package>.
macro(ortung_package_needs)
  get_property(packaged GLOBAL PROPERTY ORTUNG_PACKAGED)
  list(REMOVE_DUPLICATES packaged)
  foreach(target IN LISTS packaged)
    ortung_package_of(${target} package)
    ortung_needs(${target} needs)
    foreach(need IN LISTS needs)
      if(need MATCHES "^ortung_" AND need IN_LIST packaged)
        ortung_package_of(${need} other)
        if(NOT other STREQUAL package)
          list(APPEND ORTUNG_NEEDS_${package} ${other})
        endif()
      endif()
    endforeach()
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "SHARED_LIBRARY")  # whose package for developers has a link to it
      ortung_development_of(${package} development)
      list(APPEND ORTUNG_NEEDS_${development} ${package})
    endif()
  endforeach()
endmacro()

# ortung_describe(ortung SECTION science RECOMMENDS a b SUGGESTS c NEEDS d TEXT "Summary" "longer text")
# NEEDS names packages of ours beside those that follow from linking, DEPENDS those of others that nobody links.
macro(ortung_describe package)
  cmake_parse_arguments(ARG "ANY_MACHINE" "SECTION" "NEEDS;DEPENDS;RECOMMENDS;SUGGESTS;TEXT;CONTROL" ${ARGN})
  string(TOUPPER ${package} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${ARG_SECTION})
  list(JOIN ARG_TEXT "\n" CPACK_DEBIAN_${upper}_DESCRIPTION)
  set(needs ${ORTUNG_NEEDS_${package}} ${ARG_NEEDS})
  list(SORT needs)
  list(REMOVE_DUPLICATES needs)
  list(REVERSE needs)  # cpack turns them round
  set(CPACK_COMPONENT_${upper}_DEPENDS ${needs})
  foreach(relation DEPENDS RECOMMENDS SUGGESTS)
    list(JOIN ARG_${relation} ", " CPACK_DEBIAN_${upper}_PACKAGE_${relation})
  endforeach()
  if(ARG_ANY_MACHINE)
    set(CPACK_DEBIAN_${upper}_PACKAGE_ARCHITECTURE all)
  endif()
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA ${ARG_CONTROL})
  # What every package of Debian has. Only `cpack` asks for it, which makes the changelogs (packages/cpack.cmake).
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES ${PROJECT_BINARY_DIR}/packages/copyright ${PROJECT_BINARY_DIR}/packages/changelog.Debian.gz
          DESTINATION ${folder} COMPONENT ${package} EXCLUDE_FROM_ALL)
  set(overrides "")
  foreach(file all.lintian-overrides ${package}.lintian-overrides)
    if(EXISTS ${PROJECT_SOURCE_DIR}/cmake/packages/${file})
      file(READ ${PROJECT_SOURCE_DIR}/cmake/packages/${file} text)
      string(APPEND overrides "${text}")
    endif()
  endforeach()
  file(WRITE ${PROJECT_BINARY_DIR}/packages/overrides/${package} "${overrides}")
  install(FILES ${PROJECT_BINARY_DIR}/packages/overrides/${package}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT ${package} EXCLUDE_FROM_ALL)
endmacro()

# Files of packages that no target brings. The documentation is its site and the examples; without the site there is no
# package of it.
function(ortung_install_documents)
  if(ORTUNG_DOCS)
    set(folder ${CMAKE_INSTALL_DATADIR}/doc/ortung)
    set(documents COMPONENT ortung-doc EXCLUDE_FROM_ALL)
    install(DIRECTORY ${PROJECT_BINARY_DIR}/docs-site/html DESTINATION ${folder} ${documents} PATTERN .buildinfo EXCLUDE)
    install(CODE "set(ORTUNG_SITE \${CMAKE_INSTALL_PREFIX}/${folder}/html)\ninclude(${PROJECT_SOURCE_DIR}/cmake/packages/javascript.cmake)"
            ${documents})
    install(FILES cmake/packages/doc-base RENAME ortung-doc DESTINATION ${CMAKE_INSTALL_DATADIR}/doc-base ${documents})
    install(DIRECTORY examples/ DESTINATION ${folder}/examples ${documents} PATTERN cluster EXCLUDE)
    install(DIRECTORY python/notebooks DESTINATION ${folder}/examples ${documents} FILES_MATCHING PATTERN "*.ipynb")
    install(FILES ${PROJECT_BINARY_DIR}/packages/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/ortung-doc ${documents})
  endif()
  install(DIRECTORY examples/cluster DESTINATION ${CMAKE_INSTALL_DATADIR}/ortung COMPONENT ortung-sim
          USE_SOURCE_PERMISSIONS)
endfunction()

# The licence, and those of what is linked into the program or part of its page.
function(ortung_write_copyright)
  file(READ LICENSE licence)
  file(READ board/web/built/licences.md page)
  file(READ app/report/uplot/LICENSE charts)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/packages/copyright @ONLY CONTENT
"Ortung was written by the Ortung developers.

@licence@

The page of the viewer (in ortung-sim) contains what follows.

@page@

Reports, which the program writes, contain the charts of uPlot:

@charts@")
endfunction()

# Debian packages by `cpack -G DEB`. A macro, since cpack sees all variables that begin with CPACK_.
macro(ortung_make_packages)
  ortung_package_needs()
  ortung_install_documents()
  ortung_write_copyright()
  set(packages ${PROJECT_SOURCE_DIR}/cmake/packages)

  set(CPACK_COMPONENTS_ALL "")
  ortung_describe(libortung0 SECTION libs TEXT
    "robot localization: sensor container and MCL"
    "Ortung localizes robots by whatever sensors they have: readings live in a"
    "container, whose features say how probable they are at a pose, and Monte"
    "Carlo localization is written on that interface alone."
    "."
    "These are the libraries that a robot's own program needs. They need nothing"
    "but the standard library.")
  ortung_describe(libortung-run0 SECTION libs RECOMMENDS ortung TEXT
    "robot localization: the main job, and logs"
    "Libraries of Ortung that read records and foreign logs (MRCLAM, CARMEN, ROS"
    "2), and that run localization from a robot's file, tables and a source of"
    "readings."
    "."
    "Sensors and motions are plugins, which are in the package ortung.")
  ortung_describe(libortung-dev SECTION libdevel SUGGESTS libortung-sim-dev libortung-devices-dev ortung-doc TEXT
    "robot localization: headers for robot programs"
    "Headers, and files for CMake and pkg-config, of the libraries in libortung0"
    "and libortung-run0: container, MCL, logs and the client of Ortung's server."
    "Examples are in ortung-doc.")
  ortung_describe(libortung-sim-dev SECTION libdevel NEEDS libortung-dev TEXT
    "robot localization: headers for plugins of the simulator"
    "Headers, and files for CMake and pkg-config, for who writes sensors, drives,"
    "players or referees for Ortung's simulator, or runs it within a program.")
  ortung_describe(libortung-devices-dev SECTION libdevel NEEDS libortung-dev TEXT
    "robot localization: headers for drivers of devices"
    "Headers, and files for CMake and pkg-config, for who writes a driver of a"
    "device for Ortung, or uses what it finds in pictures.")
  ortung_describe(ortung SECTION science RECOMMENDS ortung-sim SUGGESTS ortung-devices ortung-doc TEXT
    "robot localization with whatever sensors a robot has"
    "The program ortung localizes robots from records, foreign logs (MRCLAM,"
    "CARMEN, ROS 2) and servers, and compares with ground truth. Laser scanners,"
    "sonars, landmarks, field lines and radio beacons are plugins of the same"
    "kind."
    "."
    "With maps of fields and robots to begin with.")
  ortung_describe(ortung-sim SECTION science NEEDS ortung RECOMMENDS "libosmesa6 | libegl1" SUGGESTS xdg-utils TEXT
    "robot localization: simulator, server and viewer"
    "Ortung's simulator of planar robots (rigid bodies, laser scanners, sonars,"
    "cameras), its server, the viewer for browsers, players, referees of"
    "RoboCup's F2000 and Middle Size League, and benchmarks."
    "."
    "Tables of what a sensor reads at every pose are learned in it. Pictures of"
    "cameras need OSMesa or EGL.")
  ortung_describe(ortung-devices SECTION science NEEDS ortung TEXT
    "robot localization: drivers of devices, and cameras"
    "Reads scanners, sonars, odometry and cameras of real robots into Ortung's"
    "sensor container, emulates these devices, finds lines and balls in pictures,"
    "calibrates cameras, and reads and writes MRPT's rawlogs."
    "."
    "This is the part that needs OpenCV and MRPT.")
  if(TARGET ortung-ros2)
    ortung_describe(ortung-ros2 SECTION science NEEDS ortung ortung-sim TEXT
      "robot localization: a node of ROS 2"
      "Localizes a robot that runs ROS 2, in the place of Nav2's amcl: reads scans,"
      "odometry, frames and the map, and tells the transform from map to odometry,"
      "with amcl's parameters, services and lifecycle. It talks DDS itself, so no"
      "part of ROS has to be installed.")
    install(FILES realsensors/ros2_live/launch/localization.launch.py realsensors/ros2_live/launch/floors.launch.py
            DESTINATION ${CMAKE_INSTALL_DATADIR}/ortung/launch
            COMPONENT ortung-ros2)
  endif()
  if(TARGET ortung_python)
    math(EXPR next "${Python_VERSION_MINOR} + 1")
    ortung_describe(python3-ortung SECTION python
      DEPENDS "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})"
              "python3 (<< ${Python_VERSION_MAJOR}.${next})" python3-numpy
      CONTROL ${packages}/postinst ${packages}/prerm TEXT
      "robot localization: Python package"
      "Environments to learn in, by the rules of Gymnasium and PettingZoo, and what"
      "a notebook needs of Ortung's robots, tables and records.")
  endif()
  if(ORTUNG_DOCS)
    ortung_describe(ortung-doc SECTION doc ANY_MACHINE DEPENDS libjs-sphinxdoc node-normalize.css SUGGESTS www-browser TEXT
      "robot localization: documentation and examples"
      "The documentation of Ortung for a browser, with a search that needs no"
      "network: first steps, guides to sensors, maps, real robots, ROS 2, the"
      "simulator and players, the method with its formulas, results on recordings,"
      "and the reference of commands, keys, protocol, C++ and Python."
      "."
      "Examples are robot programs in C, C++ and Python, and notebooks.")
  endif()

  # Man pages and completions of the program, once a target makes them.
  if(TARGET ortung_manuals)
    install(DIRECTORY ${PROJECT_BINARY_DIR}/manuals/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ortung
            EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.1.gz" PATTERN "ortung-ros2*" EXCLUDE)
    if(TARGET ortung-ros2)
      install(DIRECTORY ${PROJECT_BINARY_DIR}/manuals/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ortung-ros2
              EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "ortung-ros2*.1.gz")
    endif()
    install(FILES ${PROJECT_BINARY_DIR}/manuals/completions/ortung.bash RENAME ortung
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT ortung EXCLUDE_FROM_ALL)
    install(FILES ${PROJECT_BINARY_DIR}/manuals/completions/_ortung
            DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT ortung EXCLUDE_FROM_ALL)
    install(FILES ${PROJECT_BINARY_DIR}/manuals/completions/ortung.fish
            DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT ortung EXCLUDE_FROM_ALL)
  endif()

  set(CPACK_GENERATOR DEB)
  set(CPACK_PROJECT_CONFIG_FILE ${packages}/cpack.cmake)
  set(CPACK_POST_BUILD_SCRIPTS ${packages}/built.cmake)
  set(CPACK_ORTUNG_SOURCE_DIR ${PROJECT_SOURCE_DIR})
  set(CPACK_ORTUNG_BINARY_DIR ${PROJECT_BINARY_DIR})
  set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_VERBATIM_VARIABLES ON)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SOURCE ortung)
  set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
  set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${ORTUNG_MAINTAINER}")
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
  set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
      OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  include(CPack)
endmacro()
