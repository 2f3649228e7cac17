#!/bin/sh
# needed.sh LIBRARY ALLOWED...  fails if LIBRARY needs a shared library that is not allowed. A name without a version, as
# libopencv_core.so, allows all versions.
library=$1
shift
readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | {
  status=0
  while read -r needed; do
    case " $* " in
      *" $needed "* | *" ${needed%%.so*}.so "*) ;;
      *) echo "$library must not need $needed"; status=1 ;;
    esac
  done
  exit $status
}
