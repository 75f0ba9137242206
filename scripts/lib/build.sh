# shellcheck shell=bash disable=SC2154
# Setup, configuration and compilation of one preset. Sourced after common.sh.

# runSetup PRESET
runSetup() {
  case $1 in
    openmp | fuzz) "$root/scripts/setup" "--$1" ;;
    *) "$root/scripts/setup" ;;
  esac
}

# configure PRESET [KERNELS]: kernels for these levels of processors (ATRAPOS_KERNEL_LEVELS), default all
configure() {
  local preset=$1 log=$root/build/$1-configure.log prefix options=(-U ATRAPOS_KERNEL_LEVELS)
  [ -z "${2:-}" ] || options=("-DATRAPOS_KERNEL_LEVELS=$2")
  if [ "$preset" = openmp ] || [ "$preset" = tsan ]; then
    . "$root/scripts/lib/trilinos-openmp.sh"
    prefix=$(findTrilinosOpenmp)
    [ -n "$prefix" ] || die "no finished Trilinos with Kokkos OpenMP found: run scripts/setup --openmp"
    export ATRAPOS_TRILINOS_OPENMP=$prefix
    options+=(-DATRAPOS_KOKKOS_DEVICE=OPENMP)
  fi
  if command -v ccache >/dev/null; then
    # What another checkout on this machine compiled serves here; precompiled headers by their contents. DEPEND: by the files that
    # were read. By preprocessed text, GCC's precompiled header of a file whose comment has changed is the old one, which does not
    # know the file again (#pragma once), and preprocessing costs half a second a source.
    local launcher="env;CCACHE_BASEDIR=$root;CCACHE_DEPEND=1;CCACHE_SLOPPINESS=pch_defines,time_macros;ccache"
    options+=("-DCMAKE_CXX_COMPILER_LAUNCHER=$launcher" "-DCMAKE_C_COMPILER_LAUNCHER=$launcher")
  fi
  [ -z "${CI:-}" ] || options+=(-DCMAKE_COMPILE_WARNING_AS_ERROR=ON)
  mkdir -p "$root/build"
  (cd "$root" && cmake --preset "$preset" "${options[@]}") >"$log" 2>&1 || {
    cat "$log" >&2
    die "preset $preset could not be configured"
  }
  say "configured preset $preset in $root/build/$preset"
}

# build PRESET JOBS [TARGET...]
build() {
  local preset=$1 jobs=$2 started=$SECONDS
  shift 2
  say "compiling with $jobs jobs"
  ninja -C "$root/build/$preset" -j "$jobs" "$@" || die "preset $preset did not compile"
  say "compiled in $((SECONDS - started)) s"
}
