# shellcheck shell=bash disable=SC2154
# The Debian 12 packages that Atrapos is built from, and how they are installed. Sourced after common.sh.

buildPackages=(
  g++ cmake ninja-build ccache
  openmpi-bin libopenmpi-dev
  libtrilinos-teuchos-dev libtrilinos-kokkos-dev libtrilinos-kokkos-kernels-dev libtrilinos-tpetra-dev
  libtrilinos-sacado-dev libtrilinos-shards-dev libtrilinos-intrepid2-dev
  libtrilinos-amesos2-dev libtrilinos-anasazi-dev libtrilinos-belos-dev libtrilinos-ifpack2-dev
  # Amesos2's headers and package file reach into these.
  libtrilinos-epetra-dev libtrilinos-epetraext-dev libtrilinos-triutils-dev
  libtrilinos-trilinosss-dev libtrilinos-shylu-dev
  # ... and the libraries its package file names: without these nothing links.
  libscotch-dev libptscotch-dev libhdf5-openmpi-dev zlib1g-dev
  libmumps-dev libmetis-dev libexodusii-dev libnetcdf-dev
  # The reference BLAS would make every factorization several times slower.
  liblapack-dev libopenblas0-pthread
  libcli11-dev libfmt-dev nlohmann-json3-dev libyaml-cpp-dev
  libgtest-dev libbenchmark-dev libadolc-dev
  # STEP and IGES files of tools.
  libocct-data-exchange-dev
  # Meshes of Gmsh.
  libgmsh-dev
  # Models of others, for a test of `atrapos import`.
  calculix-ccx-test
  gnuplot-nox
  # The Python module.
  pybind11-dev python3-dev python3-numpy
)
# What tests use besides: a fast linker for their many programs; pages of `atrapos report` are looked at in a browser,
# meshes go to meshio.
testPackages=(lld chromium chromium-driver python3-selenium python3-meshio python3-scipy python3-matplotlib)
# Fuzz targets and sanitizers: clang, its runtime libraries, names of functions in their reports, an OpenMP that tells
# the thread sanitizer of its barriers.
fuzzPackages=(clang-14 libclang-rt-14-dev llvm-14 libomp-14-dev)
# What a Trilinos of our own links besides.
openmpPackages=(libsuitesparse-dev xz-utils)
# What fetching and building its source takes.
openmpSourcePackages=(dpkg-dev patch ca-certificates)

requireDebian12() {
  local id version
  id=$(. /etc/os-release 2>/dev/null && echo "${ID:-}") || true
  version=$(. /etc/os-release 2>/dev/null && echo "${VERSION_ID:-}") || true
  [ "$id" = debian ] && [ "$version" = 12 ] ||
    die "knows the packages of Debian 12 only (this is '$id $version'): see docs/install.md, 'Other systems'"
}

# missingPackages NAME...: those not installed, on one line.
missingPackages() {
  local installed name missing=()
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^installed //p') || true
  for name in "$@"; do
    grep -qxF -- "$name" <<<"$installed" || missing+=("$name")
  done
  echo "${missing[*]}"
}

# installPackages NAME...: installs what is missing; says nothing where nothing is.
installPackages() {
  local missing log started=$SECONDS
  missing=$(missingPackages "$@")
  [ -n "$missing" ] || return 0
  canBeRoot || die "needs packages and has neither root nor passwordless sudo; run: sudo apt-get install -y --no-install-recommends $missing"
  mkdir -p "$root/build"
  log=$root/build/setup-packages.log
  say "installing missing Debian packages ($(wc -w <<<"$missing") and what they depend on, up to a few minutes; log: $log)"
  {
    # Some unrelated source of the machine may be unreachable; what counts is the installation below.
    asRoot apt-get -o DPkg::Lock::Timeout=300 update || echo "apt-get update failed"
    # shellcheck disable=SC2086
    asRoot env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 \
      install -y --no-install-recommends $missing
  } >"$log" 2>&1 </dev/null || {
    tail -n 20 "$log" >&2
    die "apt-get could not install the packages (above: the end of $log)"
  }
  missing=$(missingPackages "$@")
  [ -z "$missing" ] || die "apt-get left these out: $missing (see $log)"
  say "packages installed in $((SECONDS - started)) s"
}
