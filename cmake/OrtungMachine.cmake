# Which machines Ortung is built for. (tests/hygiene runs this file alone, too.)
if(CMAKE_SIZEOF_VOID_P LESS 8)
  message(FATAL_ERROR "Ortung needs a 64-bit machine: table files are mapped into memory as a whole, and nothing is tested with "
    "32 bits. A Raspberry Pi from the third on is one with a 64-bit system (arm64, aarch64).")
endif()
