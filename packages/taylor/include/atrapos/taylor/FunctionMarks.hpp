#pragma once

/// The marks of functions that a law and its passes are made of: Kokkos'. Kernels with
/// ATRAPOS_WITHOUT_TRILINOS (cmake/AtraposKernels.cmake) see nothing of Trilinos, nor of Fad types: they
/// compile in less time, and a compiler cache has them for both flavours of it.
#if !defined(ATRAPOS_WITHOUT_TRILINOS)
#include <Kokkos_Macros.hpp>
#else
#define KOKKOS_FUNCTION
#define KOKKOS_INLINE_FUNCTION inline
#define KOKKOS_FORCEINLINE_FUNCTION inline __attribute__((always_inline))
#endif
