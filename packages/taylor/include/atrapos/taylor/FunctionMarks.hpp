#pragma once

/// The marks of functions that a law and its passes are made of: Kokkos', and ATRAPOS_FORCEINLINE for the
/// small ones of which thousands are called a point. Kernels with ATRAPOS_WITHOUT_TRILINOS
/// (cmake/AtraposKernels.cmake) see nothing of Trilinos, nor of Fad types: they compile in less time, and a
/// compiler cache has them for both flavours of it.
#if !defined(ATRAPOS_WITHOUT_TRILINOS)
#include <Kokkos_Macros.hpp>
#else
#define KOKKOS_FUNCTION
#define KOKKOS_INLINE_FUNCTION inline
#define KOKKOS_FORCEINLINE_FUNCTION inline __attribute__((always_inline))
#endif

/// Inlined whatever the compiler thinks of it, where it optimises. Where it does not (__NO_INLINE__: -O0),
/// all that is inlined is written out at length and stays so: tests of laws take three times as long to
/// compile.
#if defined(__NO_INLINE__)
#define ATRAPOS_FORCEINLINE KOKKOS_INLINE_FUNCTION
#else
#define ATRAPOS_FORCEINLINE KOKKOS_FORCEINLINE_FUNCTION
#endif
