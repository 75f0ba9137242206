# shellcheck shell=bash disable=SC2154
# The thread sanitizer on loops over elements and contacts. Sourced after common.sh and build.sh.

llvm=/usr/lib/llvm-14/lib

# sanitized PROGRAM [ARGUMENT...]: on four threads. libgomp tells the sanitizer nothing of its barriers: LLVM's libomp takes
# its place, under its name for the Trilinos that GCC compiled, and Archer tells. Memory that only libraries without the
# sanitizer touch (Open MPI, Trilinos, BLAS) is not looked at.
sanitized() {
  # Kernels that scatter addresses over more bits than this sanitizer knows of are asked not to, where that is allowed.
  local fixed=(setarch "$(uname -m)" -R)
  "${fixed[@]}" true 2>/dev/null || fixed=()
  "${fixed[@]}" env LD_LIBRARY_PATH="$root/build/tsan/runtime" OMP_TOOL_LIBRARIES="$llvm/libarcher.so" OMP_NUM_THREADS=4 \
    OPENBLAS_NUM_THREADS=1 \
    TSAN_OPTIONS="ignore_noninstrumented_modules=1 exitcode=66 external_symbolizer_path=/usr/bin/llvm-symbolizer-14" "$@"
}

# testThreads TEST...: behind a race, which must be found.
testThreads() {
  local folder=$root/build/tsan status=0
  mkdir -p "$folder/runtime"
  ln -sf "$llvm/libomp.so.5" "$folder/runtime/libgomp.so.1"
  sanitized "$folder/test/race" >"$folder/race.log" 2>&1 || status=$?
  if [ "$status" != 66 ] || ! grep -q 'ThreadSanitizer: data race' "$folder/race.log"; then
    die "the sanitizer does not find a race that is there ($folder/race.log)"
  fi
  say "race: found"
  (cd "$root" && sanitized ctest --preset tsan --no-tests=error -R "^($(IFS='|' && echo "$*"))\$")
}
