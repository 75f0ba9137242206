#pragma once

#include <metis.h>

#include <array>

namespace atrapos::linear {

/// What METIS is told for orderings: the same result in every run, and the best of three separators, which
/// saves more in the factorizations of a path than it costs once a run.
inline std::array<idx_t, METIS_NOPTIONS> metisOptions() {
  std::array<idx_t, METIS_NOPTIONS> options;
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NSEPS] = 3;
  return options;
}

}  // namespace atrapos::linear
