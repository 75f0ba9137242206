#!/usr/bin/env bash
# Kernels for wider instruction sets share no function with the rest of the program: the linker keeps one copy of
# a function that several objects have, which might be the one that the processor cannot run.
#
#   test/kernels_isolated.sh BUILD_FOLDER
#
# Exits with 1, naming it, where the kernels of a level show more than their tables, or have code before main that
# needs vector registers.

set -euo pipefail
cd "$1"
failed=0 count=0
for object in $(find packages src -name '*_kernels_v[234].o'); do
  count=$((count + 1))
  visible=$(nm --defined-only --extern-only "$object" | awk '{ print $3 }' | grep -v 'KernelsOf.*table' || true)
  if [ -n "$visible" ]; then
    printf '%s is not alone with:\n%s\n' "$object" "$(c++filt <<<"$visible")"
    failed=1
  fi
  if objdump -d -j .text.startup "$object" 2>/dev/null | grep -qE '%[xyz]mm'; then
    echo "$object: vector instructions before main"
    failed=1
  fi
done
echo "$count objects of kernels looked at"
[ "$count" -gt 0 ] && exit "$failed"
