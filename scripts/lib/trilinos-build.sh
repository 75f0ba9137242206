# shellcheck shell=bash disable=SC2154
# Builds Trilinos from the distribution's source package. Sourced by trilinos-openmp.sh.

# CPU minutes that the compilation took when measured.
trilinosMinutes=44

# buildTrilinosOpenmp PREFIX JOBS: the work folder stays after a failure (the next run resumes in it)
# and goes after success.
buildTrilinosOpenmp() {
  local prefix=$1 jobs=$2 work=$root/build/trilinos-openmp started=$SECONDS
  mkdir -p "$work"
  requireSpace "$work"
  [ -d "$work/source" ] || fetchTrilinos "$work"
  configureTrilinos "$work" "$prefix"
  say "compiling with $jobs jobs: about $(((trilinosMinutes + jobs / 2) / jobs)) minutes on quiet cores (log: $work/build.log)"
  NINJA_STATUS='[%f/%t] ' ninja -C "$work/build" -j "$jobs" 2>&1 </dev/null | showProgress "$work/build.log" "$jobs" || {
    grep -m 1 -A 15 '^FAILED' "$work/build.log" >&2 || tail -n 20 "$work/build.log" >&2
    die "Trilinos did not compile (log: $work/build.log); running setup again resumes"
  }
  installTrilinos "$work" "$prefix"
  rm -rf -- "$work"
  say "Trilinos built in $(minutesSince "$started") min"
}

# Sources, objects and the staged installation take about this much.
requireSpace() {
  local free needed=6
  free=$(df --output=avail -BG "$1" | tr -dc '0-9\n' | tail -n 1)
  [ "$free" -ge "$needed" ] || die "needs $needed GB in $1, $free GB are free"
}

# The source package comes through a private apt configuration that names the distribution's own
# archive, as deb-src, and leaves the machine's lists of sources alone. No root needed.
fetchTrilinos() {
  local work=$1 apt=$1/apt log=$1/fetch.log uri signed options
  say "fetching the source package of Trilinos $trilinosVersion (160 MB)"
  IFS='|' read -r uri signed < <(distributionArchive) || true
  mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial"
  echo "deb-src ${signed:+[signed-by=$signed] }${uri:-http://deb.debian.org/debian} bookworm main" >"$apt/sources.list"
  options=(-o "Dir::Etc::sourcelist=$apt/sources.list" -o Dir::Etc::sourceparts=/dev/null
    -o "Dir::State::lists=$apt/lists" -o "Dir::Cache=$apt/cache" -o APT::Sandbox::User=)
  rm -rf -- "$work/unpacked"
  mkdir "$work/unpacked"
  {
    apt-get "${options[@]}" update &&
      (cd "$work" && apt-get "${options[@]}" source --download-only --only-source trilinos) &&
      dpkg-source -x "$work"/trilinos_"$trilinosVersion"*.dsc "$work/unpacked/source" &&
      patch -d "$work/unpacked/source" -p1 <"$root/scripts/lib/trilinos-tacho.patch"
  } >"$log" 2>&1 || {
    tail -n 10 "$log" >&2
    die "the source package could not be fetched and unpacked (above: the end of $log)"
  }
  mv "$work/unpacked/source" "$work/source"
  rm -rf -- "$work"/unpacked "$work"/apt "$work"/trilinos_*
}

# URI|KEYRING of the archive that this machine installs bookworm/main from; nothing where apt does not
# say. Apt leaves $(SIGNED_BY) as it is for sources that name no keyring.
distributionArchive() {
  apt-get indextargets --format '$(REPO_URI)|$(SIGNED_BY)' 'Identifier: Packages' 'Codename: bookworm' \
    'Component: main' 'Origin: Debian' 2>/dev/null |
    sed -n '1{s/\$(SIGNED_BY)//;p}' || true
}

configureTrilinos() {
  local work=$1 prefix=$2
  say "configuring Trilinos"
  cmake -G Ninja -S "$work/source" -B "$work/build" -C "$root/scripts/lib/trilinos-openmp.cmake" \
    -DCMAKE_INSTALL_PREFIX="$prefix" >"$work/configure.log" 2>&1 </dev/null || {
    grep -A 8 'CMake Error' "$work/configure.log" | head -n 20 >&2
    die "Trilinos could not be configured (log: $work/configure.log)"
  }
}

# showProgress LOG JOBS: ninja's lines go to LOG; on the terminal one line for each percent. The costly
# files come late, so until the time spent says otherwise the estimate is the measured total's share.
showProgress() {
  local log=$1 jobs=$2 line percent last=-1 started=$SECONDS elapsed left expected
  : >"$log"
  while IFS= read -r line; do
    printf '%s\n' "$line" >>"$log"
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    percent=$((100 * BASH_REMATCH[1] / BASH_REMATCH[2]))
    [ "$percent" -gt "$last" ] || continue
    last=$percent
    elapsed=$((SECONDS - started))
    left=$((percent == 0 ? 0 : elapsed * (100 - percent) / percent))
    expected=$((trilinosMinutes * 60 * (100 - percent) / 100 / jobs))
    printf '  %3d %% (%s of %s files)  %d min %02d s elapsed, up to about %d min left\n' "$percent" "${BASH_REMATCH[1]}" \
      "${BASH_REMATCH[2]}" $((elapsed / 60)) $((elapsed % 60)) $(((left > expected ? left : expected) / 60 + 1))
  done
}

# Staged, checked, stamped, then copied beside the prefix and renamed.
installTrilinos() {
  local work=$1 prefix=$2 stage=$1/stage
  rm -rf -- "$stage"
  DESTDIR=$stage ninja -C "$work/build" install >"$work/install.log" 2>&1 || die "install failed (log: $work/install.log)"
  checkTrilinos "$stage$prefix" "$prefix"
  forPrefix "$prefix" rm -rf -- "$prefix.incoming"
  forPrefix "$prefix" mkdir -p "$(dirname "$prefix")"
  forPrefix "$prefix" cp -r "$stage$prefix" "$prefix.incoming"
  finishPrefix "$prefix.incoming" "$prefix" "built from source"
}
