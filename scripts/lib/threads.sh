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
  "${fixed[@]}" env LD_LIBRARY_PATH="$root/build/tsan/runtime" OMP_TOOL_LIBRARIES="$llvm/libarcher.so" OMP_NUM_THREADS=4 OMP_PROC_BIND=false \
    OPENBLAS_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    TSAN_OPTIONS="ignore_noninstrumented_modules=1 exitcode=66 external_symbolizer_path=/usr/bin/llvm-symbolizer-14" "$@"
}

# testThreads TEST...: behind a race, which must be found.
testThreads() {
  local folder=$root/build/tsan status=0 name binary
  mkdir -p "$folder/runtime"
  ln -sf "$llvm/libomp.so.5" "$folder/runtime/libgomp.so.1"
  sanitized "$folder/test/race" >"$folder/race.log" 2>&1 || status=$?
  if [ "$status" != 66 ] || ! grep -q 'ThreadSanitizer: data race' "$folder/race.log"; then
    die "the sanitizer does not find a race that is there ($folder/race.log)"
  fi
  say "race: found"
  status=0
  for name in "$@"; do
    binary=$(find "$folder" -type f -name "$name" -perm -u+x)
    if sanitized "$binary" >"$folder/$name.log" 2>&1; then
      say "$name: nothing found"
    else
      grep -m 1 -A 30 'WARNING: ThreadSanitizer' "$folder/$name.log" >&2 || tail -n 20 "$folder/$name.log" >&2
      say "$name: FOUND ($folder/$name.log)"
      status=1
    fi
  done
  return "$status"
}
