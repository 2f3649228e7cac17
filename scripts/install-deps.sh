#!/usr/bin/env bash
# install-deps.sh [demo|test|all|clusters|arm64]  installs what Ortung needs on Debian 12. Does nothing, and needs no rights, if all of it is
# there.
#   demo  what scripts/demo.sh builds and runs
#   test  that, and all else that is built and tested (the default)
#   all   that, and what CI and developers use besides
#   clusters  only what the tests of sweeps on many machines start: Slurm, GNU parallel, Dask
#   arm64  only what scripts/check-arm.sh needs: a cross compiler, libraries for 64-bit ARM beside those of this machine, QEMU
set -euo pipefail

demo=(
  # tools
  g++ cmake ninja-build pkg-config binutils
  # container and mcl: Eigen, and headers that stay hidden behind the file readers
  libeigen3-dev libtomlplusplus-dev nlohmann-json3-dev
  # records
  libzstd-dev zstd
  # simulator: rays, rigid bodies, maps
  libembree-dev libbox2d-dev libyaml-cpp-dev libpng-dev libboost-dev libboost-iostreams-dev
  # the program: command line, messages, texts in pictures
  libcli11-dev libspdlog-dev libfmt-dev libstb-dev
  # bags of ROS 2 and ROS 1: MCAP, SQLite, chunks of bzip2
  liblz4-dev libsqlite3-dev libbz2-dev
  # digests of what parts of a job were made from
  libxxhash-dev
)
test=(
  # compiling twice what has not changed
  ccache
  # pictures: OpenGL without a window; both are opened at run time, and one is enough
  libosmesa6-dev libegl-dev libgl-dev libegl-mesa0
  # readers of foreign logs, and drivers of laser scanners
  libmrpt-obs-dev libmrpt-maps-dev libmrpt-hwdrivers-dev
  # tests of files for MRPT: its own tools
  mrpt-apps
  # images: features, calibration, cameras; of OpenCV no more than is used
  libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-calib3d-dev libopencv-videoio-dev
  # pictures of scenes, and the test that looks at them
  python3-pil
  # tests of the schemas of files
  python3-jsonschema
  # the Python package, its wheel, and what looks at its stubs
  python3-dev pybind11-dev python3-build python3-wheel python3-pip python3-venv mypy
  # robots of ROS 2: DDS, and for the tests another implementation of it with a generator of its own, and a dissector
  libfastrtps-dev libfastcdr-dev cyclonedds-dev cyclonedds-tools tshark
  # tests of bags of ROS 1: its own recorder and messages
  python3-rosbag python3-nav-msgs python3-sensor-msgs python3-tf2-msgs
  # training of motion networks
  libdlib-dev libblas-dev
  # tests
  libgtest-dev librapidcheck-dev python3 python3-numpy
  # counts of the instructions of hot calls
  valgrind
  # pictures of the Python package
  python3-matplotlib
  # the viewer's page in a real browser; Node.js, which builds it, is not Debian 12's (20.19 or later)
  chromium
  # the documentation's site
  python3-sphinx furo python3-breathe python3-myst-parser python3-sphinx-copybutton doxygen
)
all=(
  # Debian packages and libraries, and what looks at them
  dpkg-dev file debootstrap lintian abigail-tools
  # benchmarks, fuzz targets, format, lint
  libbenchmark-dev clang-19 libclang-rt-19-dev clang-format-19 clang-tidy-19
)
clusters=(
  slurmctld slurmd slurm-client munge parallel python3-distributed procps
)
arm64=(
  g++-aarch64-linux-gnu qemu-user cmake ninja-build libeigen3-dev nlohmann-json3-dev
  libtomlplusplus-dev:arm64 libzstd-dev:arm64 libgtest-dev:arm64 librapidcheck-dev:arm64
)

case ${1:-test} in
  demo) packages=("${demo[@]}") ;;
  test) packages=("${demo[@]}" "${test[@]}") ;;
  all) packages=("${demo[@]}" "${test[@]}" "${all[@]}") ;;
  clusters) packages=("${clusters[@]}") ;;
  arm64) packages=("${arm64[@]}") ;;
  *) echo "usage: $0 [demo|test|all|clusters|arm64]" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [[ $status == "install ok installed" ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "install-deps: all ${#packages[@]} packages are there"
  exit 0
fi

as_root=()
if [[ $(id -u) != 0 ]]; then
  command -v sudo >/dev/null || { echo "install-deps: needs root or sudo to install: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "install-deps: installing ${missing[*]}"
if [[ ${1:-test} == arm64 ]]; then
  "${as_root[@]}" dpkg --add-architecture arm64
fi
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -q --no-install-recommends "${missing[@]}"
