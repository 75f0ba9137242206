# shellcheck shell=bash disable=SC2154
# What the scripts share: messages, root rights, the number of jobs. Sourced, never run.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=$(basename "$0")

say() { printf '%s: %s\n' "$program" "$*"; }

die() {
  printf '%s: %s\n' "$program" "$*" >&2
  exit 1
}

# usage TEXT...: the script's opening comment is its help.
printHelp() { sed -n '2,/^$/s/^# \{0,1\}//p' "$0"; }

minutesSince() { echo $(((SECONDS - $1 + 30) / 60)); }

canBeRoot() { [ "$(id -u)" = 0 ] || sudo -n true 2>/dev/null; }

asRoot() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo -n "$@"; fi
}

# True where this user may create DIR (its nearest existing parent is writable).
canCreate() {
  local directory=$1
  while [ ! -e "$directory" ]; do directory=$(dirname "$directory"); done
  [ -d "$directory" ] && [ -w "$directory" ]
}

# Compile jobs: one a core, but not more than the free memory carries at 2 GB each, which is
# what a file full of Tpetra templates can take.
buildJobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 2097152) }' /proc/meminfo)
  [ "$memory" -ge 1 ] || memory=1
  echo $((cores < memory ? cores : memory))
}
