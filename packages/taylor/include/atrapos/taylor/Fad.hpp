#pragma once

/// Sacado's Fad types, the scalars of a law's tangent as tests and reference implementations want it. Kernels
/// with ATRAPOS_WITHOUT_TRILINOS (FunctionMarks.hpp) have nothing of them: their tangents are made in lanes.
#if !defined(ATRAPOS_WITHOUT_TRILINOS)
#include <Sacado_Fad_SFad.hpp>
#endif
