# The folders of what tests share, for target_include_directories: ${support}.
configure_file(${CMAKE_CURRENT_LIST_DIR}/Paths.hpp.in ${PROJECT_BINARY_DIR}/tests/support/Paths.hpp @ONLY)
set(support ${CMAKE_CURRENT_LIST_DIR} ${PROJECT_BINARY_DIR}/tests/support)
