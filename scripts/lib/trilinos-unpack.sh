# shellcheck shell=bash disable=SC2154
# Unpacks an archive of a finished build. Sourced by trilinos-openmp.sh.

# unpackTrilinosOpenmp ARCHIVE PREFIX
unpackTrilinosOpenmp() {
  local archive=$1 prefix=$2 incoming=$2.incoming name entries
  entries=$(tar -tf "$archive" 2>/dev/null) || die "--from $archive: not a tar archive, or damaged"
  name=$(cut -d/ -f1 <<<"$entries" | sort -u)
  [ "$(wc -l <<<"$name")" = 1 ] || die "--from $archive: should hold one folder, holds: $(tr '\n' ' ' <<<"$name" | cut -c1-80)"
  requireBuiltFor "$prefix" "$(tar -xOf "$archive" "$name/$trilinosConfig" 2>/dev/null)"
  if [ -e "$prefix" ]; then
    adoptOrRefuse "$archive" "$name" "$prefix"
    return
  fi
  say "unpacking $archive"
  forPrefix "$prefix" rm -rf -- "$incoming"
  forPrefix "$prefix" mkdir -p "$incoming"
  forPrefix "$prefix" tar -xf "$archive" -C "$incoming" --no-same-owner || die "--from $archive: could not be unpacked"
  (checkTrilinos "$incoming/$name" "$prefix") || {
    forPrefix "$prefix" rm -rf -- "$incoming"
    exit 1
  }
  finishPrefix "$incoming/$name" "$prefix" "unpacked from $(basename "$archive")"
  forPrefix "$prefix" rm -rf -- "$incoming"
}

# A prefix without the stamp may be the archive unpacked by hand: every file the same makes it finished.
adoptOrRefuse() {
  local archive=$1 name=$2 prefix=$3
  if [ "$(basename "$prefix")" = "$name" ] && tar -df "$archive" -C "$(dirname "$prefix")" >/dev/null 2>&1; then
    checkTrilinos "$prefix" "$prefix"
    forPrefix "$prefix" sh -c 'printf "%s\n" "$2" >"$1"' sh "$prefix/$stamp" \
      "Trilinos $trilinosVersion, Kokkos OpenMP, found identical to $(basename "$archive")"
  else
    refuseUnfinished "$prefix"
  fi
}
