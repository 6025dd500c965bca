#!/bin/bash
# Compiles what ninja finds to do, of the targets given or of all. On a terminal it counts; elsewhere it says once how many
# steps there are. What compilers say goes through.
set -euo pipefail
terminal=
if [ -t 1 ]; then
  terminal=yes
fi

show() {
  local line said=
  while IFS= read -r line; do
    case $line in
      'ninja: no work to do.' | 'ninja: Entering directory'* | *'/'*'] Re-'*) ;;
      '['*'] '*)
        line=${line%%\]*}
        line=${line#\[}
        if [ "$terminal" ]; then
          printf '\rCompiling: %s of %s' "${line%/*}" "${line#*/}"
        elif [ ! "$said" ]; then
          echo "Compiling (steps: ${line#*/})"
        fi
        said=yes
        ;;
      *) printf '%s\n' "$line" ;;
    esac
  done
  if [ "$terminal$said" = yesyes ]; then
    echo
  fi
}

NINJA_STATUS='[%f/%t] ' ninja -C build "$@" 2>&1 | show
