# shellcheck shell=bash disable=SC2154,SC2034
# Runs the targets of test/fuzz. Sourced after common.sh.

fuzzTargets=(deck formula inp mesh restart table)

# Names of functions in reports.
export ASAN_SYMBOLIZER_PATH=/usr/bin/llvm-symbolizer-14

# The longest input of a target: about twice that of what it starts from.
longestOf() {
  case $1 in
    formula) echo 200 ;;
    mesh) echo 24000 ;;
    *) echo 4096 ;;
  esac
}

# seedsOf TARGET: folders of inputs to start from.
seedsOf() {
  local folder=$root/build/fuzz-seeds/$1
  mkdir -p "$folder"
  case $1 in
    deck) find "$root/examples" -name '*.yaml' -size -8k -exec cp -t "$folder" --backup=numbered {} + ;;
    inp) find "$root/examples" -name '*.inp' -size -8k -exec cp -t "$folder" {} + ;;
  esac
  echo "$folder"
  [ ! -d "$root/test/fuzz/corpus/$1" ] || echo "$root/test/fuzz/corpus/$1"
}

# dictionaryOf TARGET: words of its language, from what is written of it; empty for targets without.
dictionaryOf() {
  local file=$root/build/fuzz-seeds/$1.dict
  case $1 in mesh | restart) return ;; esac  # numbers, not words
  mkdir -p "$root/build/fuzz-seeds"
  case $1 in
    deck) grep -rhoE --include='*.yaml' '[a-z_]+:' "$root/examples" ;;
    formula) printf '%s\n' exp log log10 sqrt sin cos tan asin acos atan sinh cosh tanh erf pow dot grad pi lambda phi T k zero x y z ;;
    inp) grep -oE '\*[A-Z][A-Z ]+[A-Z]' "$root/docs/import.md" ;;
    table) printf '%s\n' step branch path_length load_factor kind negative_change nullity frequency uncertainty tip \
      negative_eigenvalues residual maximum hopf %% ;;
  esac | sort -u | sed 's/.*/"&"/' >"$file"
  echo "$file"
}

# fuzzOne TARGET OPTION...: one line of what came of it; the log is in build/fuzz-found.
fuzzOne() {
  local target=$1 found=$root/build/fuzz-found corpus=$root/build/fuzz-corpus/$1 log status=0 seeds dictionary
  shift
  # A mutation of an Exodus file costs as much as reading it.
  [ "$target" != mesh ] || set -- "$@" -mutate_depth=1
  mkdir -p "$found" "$corpus"
  # Half as fast again: less memory waits for a use after its end, and stacks of allocations are short. What was found is
  # told in full where the target is run on it without these.
  export ASAN_OPTIONS=quarantine_size_mb=2:malloc_context_size=2:max_malloc_fill_size=0
  log=$found/$target.log
  mapfile -t seeds < <(seedsOf "$target")
  dictionary=$(dictionaryOf "$target")
  # Longer than 10 s is a hang.
  "$root/build/fuzz/test/fuzz/${target}_fuzz" "$@" -timeout=10 -rss_limit_mb=2048 -max_len="$(longestOf "$target")" \
    ${dictionary:+-dict="$dictionary"} -print_final_stats=1 -artifact_prefix="$found/$target-" "$corpus" "${seeds[@]}" \
    >"$log" 2>&1 </dev/null || status=$?
  if [ "$status" = 0 ]; then
    say "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") executions, nothing found"
  else
    tail -n 40 "$log" >&2
    say "$target: FOUND (exit code $status): $(sed -n 's/.*Test unit written to //p' "$log")"
  fi
  return "$status"
}

# fuzzAll JOBS OPTION... -- TARGET...
fuzzAll() {
  local jobs=$1 options=()
  shift
  while [ "$1" != -- ]; do
    options+=("$1")
    shift
  done
  shift
  export root program
  export -f fuzzOne seedsOf dictionaryOf longestOf say
  printf '%s\0' "$@" | xargs -0 -P "$jobs" -I TARGET bash -c 'fuzzOne "$@"' fuzz TARGET "${options[@]}" ||
    die "something was found (build/fuzz-found)"
}

# minimiseCorpus TARGET
minimiseCorpus() {
  local target=$1 corpus=$root/test/fuzz/corpus/$1 merged=$root/build/fuzz-merged/$1 seeds
  mapfile -t seeds < <(seedsOf "$target")
  rm -rf -- "$merged"
  mkdir -p "$merged" "$corpus"
  # Branches, not how often each is taken; those that the examples take count as taken.
  cp -t "$merged" "${seeds[0]}"/* 2>/dev/null || true
  "$root/build/fuzz/test/fuzz/${target}_fuzz" -set_cover_merge=1 -use_counters=0 -max_len="$(longestOf "$target")" "$merged" \
    "$corpus" "$root/build/fuzz-corpus/$target" >"$root/build/fuzz-merged/$target.log" 2>&1 </dev/null ||
    die "$target: could not be minimised (build/fuzz-merged/$target.log)"
  (cd "${seeds[0]}" && find . -type f -exec rm -f "$merged/{}" \;)
  # No more than 100 kB of a target in the repository: the shortest.
  find "$merged" -type f -printf '%s %p\n' | sort -n | awk '(sum += $1) > 100000 { print $2 }' | xargs -r rm -f --
  rm -rf -- "$corpus"
  mv "$merged" "$corpus"
  say "$target: $(find "$corpus" -type f | wc -l) inputs, $(du -bs "$corpus" | cut -f1) bytes"
}

# testMutators MUTANTS BUILD
testMutators() {
  export ATRAPOS_MUTANTS=$1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  cd "$root" || exit 1
  "$2"/src/deck/testMutants
  "$2"/src/import/testInpMutants
  "$2"/src/test/testSurfaceMutants
  "$2"/packages/exodus/testExodusHostile --gtest_filter='*mutants'
}
