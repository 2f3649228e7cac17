#!/bin/sh
# deps.sh ROOT  scripts/install-deps.sh installs whatever CMake files and scripts look for.
cd "$1" || exit 2
status=0
packages=$(sed -n '/^[a-z0-9]*=($/,/^)/p' scripts/install-deps.sh | grep -v '^ *#')

# The Debian package of what a CMake file or a script calls NAME; - for what is there already.
package_of() {
  case $1 in
    BLAS) echo libblas-dev ;; BZip2) echo libbz2-dev ;; SQLite3) echo libsqlite3-dev ;; fastrtps) echo libfastrtps-dev ;; CycloneDDS) echo cyclonedds-dev ;; idlc) echo cyclonedds-tools ;; Boost) echo libboost-dev ;; CLI11) echo libcli11-dev ;; Eigen3) echo libeigen3-dev ;;
    GTest) echo libgtest-dev ;; OrtungOpenCV) echo - ;; opencv2/core.hpp) echo libopencv-core-dev ;; opencv_*) echo "libopencv-${1#opencv_}-dev" ;; PNG) echo libpng-dev ;; Python3) echo python3 ;; Python) echo python3-dev ;; pybind11) echo pybind11-dev ;; benchmark) echo libbenchmark-dev ;;
    box2d) echo libbox2d-dev ;; embree) echo libembree-dev ;; fmt) echo libfmt-dev ;; mrpt-maps) echo libmrpt-maps-dev ;;
    mrpt-hwdrivers) echo libmrpt-hwdrivers-dev ;; mrpt-obs) echo libmrpt-obs-dev ;; nlohmann_json) echo nlohmann-json3-dev ;; rapidcheck) echo librapidcheck-dev ;;
    spdlog) echo libspdlog-dev ;; tomlplusplus) echo libtomlplusplus-dev ;; yaml-cpp) echo libyaml-cpp-dev ;; zstd) echo libzstd-dev ;; zstdcat) echo zstd ;;
    iostreams) echo libboost-iostreams-dev ;; dlib/*) echo libdlib-dev ;; stb/*) echo libstb-dev ;; GL/osmesa.h) echo libosmesa6-dev ;; EGL/egl.h) echo libegl-dev ;; lz4frame.h) echo liblz4-dev ;; xxhash.h) echo libxxhash-dev ;; ccache) echo ccache ;;
    clang-19 | clang-format-19 | python3 | cmake | pkg-config) echo "$1" ;; clang++-19) echo clang-19 ;;
    valgrind/callgrind.h) echo valgrind ;; Ninja | ninja) echo ninja-build ;; readelf) echo binutils ;;
    aarch64-linux-gnu-g++) echo g++-aarch64-linux-gnu ;; qemu-aarch64) echo qemu-user ;;
    PIL) echo python3-pil ;; numpy) echo python3-numpy ;; dpkg-architecture | dpkg-shlibdeps) echo dpkg-dev ;; debootstrap | lintian) echo "$1" ;;
    Threads | ortung | dpkg-deb) echo - ;; *) echo "?" ;;
  esac
}

cmake_files=$(find . -name build -prune -o \( -name CMakeLists.txt -o -name '*.cmake' \) -print | grep -v tests/consumer)
names=$({
  # shellcheck disable=SC2086  # no blanks in our own names
  sed -nE 's/^ *find_package\(([A-Za-z0-9_-]+).*/\1/p; s/^ *find_program\([A-Z_]+ ([a-z0-9.-]+).*/\1/p;
           s/^ *find_path\([A-Z_]+ ([^ )]+).*/\1/p; s/.*COMPONENTS (iostreams).*/\1/p' \
    $cmake_files
  # shellcheck disable=SC2086
  sed -nE 's/^ *find_package\(OrtungOpenCV .*COMPONENTS ([a-z0-9 ]+)\).*/\1/p' $cmake_files | tr ' ' '\n' | sed 's/^/opencv_/'
  sed -nE 's/^set\(CMAKE_(CXX_COMPILER|CROSSCOMPILING_EMULATOR) ([a-z0-9+-]+)\)/\2/p' cmake/*.cmake
  sed -nE 's/.*"CXX?": "([^"]+)".*/\1/p; s/.*"generator": "([^"]+)".*/\1/p' CMakePresets.json
  grep -ohE 'clang-format-[0-9]+|\b(ninja|ccache|python3|cmake|pkg-config|readelf|zstdcat|debootstrap|lintian|dpkg-architecture)\b' scripts/*.sh tests/hygiene/*.sh
  grep -ohE '^ *(import|from) (PIL|numpy)' scripts/*.py examples/*.py tests/*/*.py 2> /dev/null | sed 's/.* //'
} | sort -u)
[ "$(echo "$names" | wc -l)" -gt 20 ] || { echo "too little was found to look for: $names"; exit 1; }
for name in $names; do
  package=$(package_of "$name")
  case $package in
    -) continue ;;
    "?") echo "$name is looked for; tests/hygiene/deps.sh does not know its package" ; status=1 ; continue ;;
  esac
  echo "$packages" | tr ' ' '\n' | grep -qxF -e "$package" || { echo "scripts/install-deps.sh lacks $package, for $name"; status=1; }
done
exit $status
