#pragma once

#include <string>

namespace atrapos::fem {

/// Lanes of the kernels that this process uses: 8 (x86-64-v4, AVX-512), 4 (x86-64-v3, AVX2) or 2 (x86-64-v2,
/// SSE4.2) where the program has kernels for each, the widest that the processor has, or what the environment
/// variable ATRAPOS_KERNELS asks for (v2, v3, v4); else those of the one instruction set it was compiled for.
/// Throws std::invalid_argument, one line, for a level that is unknown or that the processor does not have.
int processorLanes();

/// The same in words: "x86-64-v3 (4 lanes), chosen of v2, v3 and v4".
std::string describeKernels();

}  // namespace atrapos::fem
