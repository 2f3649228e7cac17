#!/bin/sh
# includes.sh ROOT  each folder includes only what lies below it; foreign libraries stay in one place.
cd "$1" || exit 2
status=0

# deny "FOLDERS" PATTERN [ALLOWED]  no file of FOLDERS, but those whose path matches ALLOWED, includes PATTERN.
deny() {
  for folder in $1; do
    [ -d "$folder" ] || continue
    found=$(grep -rnE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($2)" "$folder" \
              --include=*.hpp --include=*.h --include=*.cpp | grep -vE "^(${3:-nothing/is/allowed})")
    if [ -n "$found" ]; then
      echo "$found"
      echo "-> $folder must not include the above"
      status=1
    fi
  done
}

foreign='mrpt|opencv|embree|GL/|EGL/|box2d|boost|spdlog|fmt/|CLI/'
deny 'container' "ortung/(mcl|sim|sim_api|realsensors|server|served|client)|$foreign"
deny 'container' 'toml\+\+|toml\.|nlohmann' 'container/robot/'
deny 'container mcl sim plugins realsensors app' 'zstd\.h|lz4' '(container/records/src/Zstd|realsensors/ros2/src/Compression)\.cpp'
deny 'mcl' "ortung/(sim|sim_api|realsensors|server|served|client)|toml|nlohmann|$foreign" 'mcl/(player/.*sim_api/|served/.*(server|sim)/)'
deny 'container mcl/include mcl/src mcl/run sim/api sim/src sim/include board/remote realsensors' 'ortung/mcl_player/'
deny 'plugins/sensors plugins/motion plugins/sources plugins/referees' 'ortung/mcl_player/'
# Filters for clients of a server: only who serves sees them; of the simulator they know the learner's tables alone.
deny 'container mcl/include mcl/src mcl/run play/mcl_player sim plugins realsensors' 'ortung/mcl_served/'
deny 'board/worlds/mcl_served' 'ortung/(served|sim_api|realsensors|client|remote)/|ortung/sim/[^T]'
deny 'mcl/include mcl/src' 'ortung/(robot|run)/'
# The main job as a library: whoever uses it prints by himself and has his own command line.
headers_of_app=$(ls app/*/*.hpp | xargs -n1 basename | sed 's/\.hpp$//' | paste -sd '|')
deny 'mcl/run' "(.*/)?($headers_of_app)\\.hpp|unistd|csignal|iostream"
# MCL for players sees a seat, not who runs it.
deny 'play/mcl_player' 'ortung/(sim|realsensors|server|served|client|remote|benchmark)/|toml|nlohmann'
deny 'sim/api' "ortung/(mcl|sim|realsensors|robot|server|served|client)/|toml|nlohmann|$foreign"
deny 'sim' 'ortung/(mcl|run|realsensors)/|mrpt|opencv'
deny 'board/client' "ortung/(mcl|sim|sim_api|realsensors|server|served)/|toml|nlohmann|$foreign"
deny 'board/remote' "ortung/(mcl|sim|realsensors|server|served)/|toml|nlohmann|$foreign"
deny 'board/server' "ortung/(mcl|sim|sim_api|realsensors|served|client)/|toml|nlohmann|mrpt|opencv|embree|GL/|box2d"
deny 'board/refbox' "ortung/(mcl|sim|realsensors|robot|server|served|client)/|toml|mrpt|opencv|embree|GL/|box2d"
deny 'board/web' "ortung/(mcl|run|sim|sim_api|realsensors|robot|server|served|client)/|toml|nlohmann|mrpt|opencv|embree|GL/|box2d"
deny 'sim/src sim/include' 'ortung/(server|served|client|refbox|web)/'
deny 'play/benchmark' 'ortung/(server|served|client|refbox|remote)/'
deny 'sim/src sim/include sim/api board/server board/worlds/served board/client board/refbox board/remote' 'ortung/benchmark/'
deny 'container mcl sim plugins realsensors app' 'boost/(asio|beast)' 'sim/(server/src/(AddressKey\.|Arrival\.|Session\.|MessageBoard\.cpp)|refbox/src/RefBoxClient\.cpp|web/src/)'
# Pictures see the world through sim/api alone, as the plugins that take them do.
deny 'sim/pictures' "ortung/(mcl|run|sim|server|served|client|refbox|remote|robot)/|toml|nlohmann|$foreign"
deny 'container mcl sim/api sim/src sim/include board/server board/worlds/served board/client board/refbox board/remote' 'ortung/pictures/'
deny 'play/learning' "ortung/(mcl|run|server|served|client|refbox|remote)/|toml|nlohmann|$foreign"
deny 'container mcl sim/api sim/src sim/include board/server board/worlds/served board/client board/refbox board/remote play/benchmark plugins realsensors' 'ortung/learning/'
deny 'plugins' 'ortung/(mcl|run|realsensors)/|mrpt|opencv|embree|GL/|box2d'
deny 'realsensors' 'ortung/(mcl|sim|sim_api)/|embree|GL/|box2d'
deny 'container mcl sim plugins realsensors app' 'mrpt' 'realsensors/mrpt'

# Of OpenCV, robots need core and imgproc; files and chessboards are for calibration, videos for the driver of cameras.
deny 'container mcl sim plugins realsensors app' 'opencv2/' '(realsensors/vision/src/BlobFinder\.cpp|realsensors/calibration/src/|realsensors/devices/plugins/CameraDevice\.cpp)'
deny 'realsensors/vision' 'ortung/calibration/|opencv2/(imgcodecs|calib3d|videoio|highgui|ccalib|opencv)'
deny 'realsensors/calibration' 'opencv2/(videoio|highgui|ccalib|opencv)'
deny 'container mcl sim plugins realsensors/core realsensors/devices' 'ortung/calibration/'

# What runs on a robot knows no emulator of its devices; neither knows who opens it.
deny 'container mcl sim plugins realsensors/core realsensors/devices realsensors/mrpt_devices' 'ortung/emulators/'
deny 'realsensors/devices realsensors/emulators realsensors/mrpt_devices' "ortung/(run|server|served|client)/|toml|nlohmann|opencv" 'realsensors/devices/plugins/CameraDevice'
deny 'container mcl sim plugins' 'ortung/devices/'
# Messages of ROS 2 are for the program and the plugin that reads them.
deny 'container mcl sim plugins realsensors/core realsensors/devices' 'ortung/(ros2|foxglove)/'
# It speaks for the board, and knows its words alone.
deny 'realsensors/foxglove' 'ortung/(run|robot|records|server|served|client|web)/|toml|boost|opencv'
deny 'realsensors/ros2' 'ortung/foxglove/'
deny 'realsensors/ros2' "ortung/(run|robot|records|server|served|client)/|toml|nlohmann|opencv"

# Rooms of the container in the order of their dependencies: each sees those before it alone. Private
# headers are included by their names.
later='base tables core formats motion camera robot records'
for room in $later; do
  later=${later#"$room"}
  later=${later# }
  for above in $later; do
    deny "container/$room" "ortung/$above/"
    for header in "container/$above"/src/*.hpp; do
      [ -e "$header" ] && deny "container/$room" "$(basename "$header" .hpp)\\.hpp"
    done
  done
done

# Public headers name no library but the standard one and Eigen.
for folder in container/*/include mcl/include mcl/run/include play/mcl_player/include board/worlds/mcl_served/include sim/include sim/api/include board/server/include \
              board/worlds/served/include board/client/include board/refbox/include board/remote/include play/benchmark/include \
              sim/pictures/include board/web/include realsensors/ros2/include realsensors/foxglove/include realsensors/vision/include realsensors/calibration/include realsensors/devices/include realsensors/emulators/include; do
  deny "$folder" "toml|nlohmann|$foreign"
done

# A library that is large or strange is included from one folder only.
for library in embree GL/ EGL/ box2d; do
  folders=$(grep -rlE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($library)" container mcl sim plugins realsensors app \
              --include=*.hpp --include=*.cpp 2>/dev/null | xargs -r -n1 dirname | sort -u)
  if [ "$(echo "$folders" | grep -c .)" -gt 1 ]; then
    echo "$library is included in more than one folder:"
    echo "$folders"
    status=1
  fi
done
exit $status
