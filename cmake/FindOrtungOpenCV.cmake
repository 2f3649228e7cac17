# find_package(OrtungOpenCV 4.6 REQUIRED COMPONENTS core imgproc)
# OpenCV's modules, those that are asked for, as the targets opencv_core, ... What Debian installs with OpenCV for
# find_package(OpenCV) wants all modules, and with them windows (Qt) and 3D views (VTK), of which nothing is used here.
find_path(ORTUNG_OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
mark_as_advanced(ORTUNG_OPENCV_INCLUDE_DIR)
if(ORTUNG_OPENCV_INCLUDE_DIR)
  file(STRINGS ${ORTUNG_OPENCV_INCLUDE_DIR}/opencv2/core/version.hpp lines
       REGEX "#define CV_VERSION_(MAJOR|MINOR|REVISION) +[0-9]+")
  string(REGEX REPLACE "[^;]* ([0-9]+)" "\\1" OrtungOpenCV_VERSION "${lines}")
  list(JOIN OrtungOpenCV_VERSION "." OrtungOpenCV_VERSION)
endif()
foreach(module IN LISTS OrtungOpenCV_FIND_COMPONENTS)
  find_library(ORTUNG_OPENCV_${module}_LIBRARY opencv_${module})
  mark_as_advanced(ORTUNG_OPENCV_${module}_LIBRARY)
  if(ORTUNG_OPENCV_${module}_LIBRARY AND EXISTS ${ORTUNG_OPENCV_INCLUDE_DIR}/opencv2/${module}.hpp)
    set(OrtungOpenCV_${module}_FOUND TRUE)
  endif()
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OrtungOpenCV
  REQUIRED_VARS ORTUNG_OPENCV_INCLUDE_DIR VERSION_VAR OrtungOpenCV_VERSION HANDLE_COMPONENTS)
if(OrtungOpenCV_FOUND)
  foreach(module IN LISTS OrtungOpenCV_FIND_COMPONENTS)
    if(NOT TARGET opencv_${module})  # a parent's project may have found OpenCV by itself
      add_library(opencv_${module} UNKNOWN IMPORTED)
      set_property(TARGET opencv_${module} PROPERTY IMPORTED_LOCATION ${ORTUNG_OPENCV_${module}_LIBRARY})
    endif()
    # An imported target's headers give no warnings: these mix kinds of enumerations, which C++20 deprecates.
    set_property(TARGET opencv_${module} PROPERTY INTERFACE_INCLUDE_DIRECTORIES ${ORTUNG_OPENCV_INCLUDE_DIR})
  endforeach()
endif()
