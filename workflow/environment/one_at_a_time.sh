#!/bin/bash
# Runs a command under a lock of this folder. The kernel releases the lock when the processes that hold it have exited.
mkdir -p build && exec 9>build/lock || exit
message=$(flock --nonblock --conflict-exit-code 75 9 2>&1)
case $? in
  0) ;;
  75) echo 'Another make is running in this folder: wait for it to finish.' >&2; exit 1 ;;
  *) echo "File locks do not work here (${message##*: }): do not run two makes at once in this folder." >&2 ;;
esac
exec "$@"
