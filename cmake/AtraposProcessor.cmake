# ATRAPOS_PROCESSOR_HAS_v2, _v3, _v4: whether this machine runs code for x86-64-v2, -v3, -v4.
include(CheckCXXSourceRuns)
foreach(level v2 v3 v4)
  check_cxx_source_runs(
    "int main() { return __builtin_cpu_supports(\"x86-64-${level}\") ? 0 : 1; }" ATRAPOS_PROCESSOR_HAS_${level})
endforeach()
