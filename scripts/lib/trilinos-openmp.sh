# shellcheck shell=bash disable=SC2154
# A Trilinos 13.2 with Kokkos OpenMP: found, unpacked from an archive, or built. Sourced after packages.sh.
#
# A prefix counts as finished only when it carries the stamp. Both ways of making one fill a folder
# beside it and rename that at the very end, so an interrupted run leaves no half-filled prefix.

trilinosVersion=13.2.0
systemPrefix=/opt/atrapos/trilinos-$trilinosVersion-openmp
homePrefix=${HOME:-/nonexistent}/.local/atrapos/trilinos-$trilinosVersion-openmp
stamp=.atrapos-complete

isFinished() { [ -f "$1/$stamp" ]; }

# The finished prefix that `--preset openmp` should use; nothing where there is none.
findTrilinosOpenmp() {
  local candidate
  for candidate in ${ATRAPOS_TRILINOS_OPENMP:+"$ATRAPOS_TRILINOS_OPENMP"} "$systemPrefix" "$homePrefix"; do
    if isFinished "$candidate"; then
      echo "$candidate"
      return
    fi
  done
}

# setupTrilinosOpenmp PREFIX|'' ARCHIVE|'' JOBS
setupTrilinosOpenmp() {
  local prefix=${1:-${ATRAPOS_TRILINOS_OPENMP:-}} archive=$2 jobs=$3
  if [ -z "$prefix" ]; then
    prefix=$(findTrilinosOpenmp)
  fi
  if [ -z "$prefix" ]; then
    if canCreate "$systemPrefix" || canBeRoot; then
      prefix=$systemPrefix
    else
      prefix=$homePrefix
    fi
  fi
  installPackages "${openmpPackages[@]}"
  if isFinished "$prefix"; then
    return
  fi
  canCreate "$prefix" || canBeRoot || die "cannot write $prefix (no root, no passwordless sudo): give another --prefix"
  if [ -n "$archive" ]; then
    . "$root/scripts/lib/trilinos-unpack.sh"
    unpackTrilinosOpenmp "$archive" "$prefix"
  else
    refuseUnfinished "$prefix"
    installPackages "${openmpSourcePackages[@]}"
    . "$root/scripts/lib/trilinos-build.sh"
    buildTrilinosOpenmp "$prefix" "$jobs"
  fi
  say "Trilinos $trilinosVersion with Kokkos OpenMP is in $prefix"
  if [ "$(findTrilinosOpenmp)" != "$prefix" ]; then
    say "to use it: export ATRAPOS_TRILINOS_OPENMP=$prefix"
  fi
}

refuseUnfinished() {
  [ ! -e "$1" ] || die "$1 exists but is no finished build (no $stamp in it): remove it or give another --prefix"
}

# The rights that writing PREFIX takes.
forPrefix() {
  local prefix=$1
  shift
  if canCreate "$prefix"; then "$@"; else asRoot "$@"; fi
}

trilinosConfig=lib/cmake/Trilinos/TrilinosConfig.cmake

# requireBuiltFor PREFIX TEXT: TEXT, a TrilinosConfig.cmake, names PREFIX. Package files and library
# search paths carry it, so such a build cannot be moved.
requireBuiltFor() {
  local prefix=$1 built
  built=$(sed -n 's/^set(Trilinos_INSTALL_DIR "\(.*\)")$/\1/p' <<<"$2")
  [ -n "$built" ] || die "no $trilinosConfig found: not an installed Trilinos"
  [ "$built" = "$prefix" ] ||
    die "this Trilinos was built for $built and works nowhere else (wanted: $prefix); build one with --openmp --prefix $prefix"
}

# checkTrilinos FOLDER PREFIX: FOLDER holds a Trilinos with OpenMP that was built to live in PREFIX.
checkTrilinos() {
  local folder=$1 prefix=$2 unresolved
  requireBuiltFor "$prefix" "$(cat "$folder/$trilinosConfig" 2>/dev/null)"
  grep -q 'Kokkos_DEVICES.*OPENMP' "$folder/lib/cmake/Kokkos/KokkosConfig.cmake" ||
    die "this Trilinos has no Kokkos OpenMP"
  unresolved=$(LD_LIBRARY_PATH=$folder/lib ldd "$folder"/lib/*.so 2>&1 | grep -E 'not found|not a dynamic' | sort -u | head -n 3) || true
  [ -z "$unresolved" ] || die "its libraries cannot be loaded here: $unresolved"
}

# finishPrefix FOLDER PREFIX ORIGIN: stamps FOLDER and renames it to PREFIX (same file system).
finishPrefix() {
  local folder=$1 prefix=$2 origin=$3
  forPrefix "$prefix" sh -c 'printf "%s\n" "$2" >"$1"' sh "$folder/$stamp" "Trilinos $trilinosVersion, Kokkos OpenMP, $origin"
  forPrefix "$prefix" mv -T "$folder" "$prefix"
}
