#pragma once

/// Everything a law may call on its scalar besides + - * /.
#include "atrapos/taylor/Comparison.hpp"
#include "atrapos/taylor/Exponential.hpp"
#include "atrapos/taylor/Hyperbolic.hpp"
#include "atrapos/taylor/Power.hpp"
#include "atrapos/taylor/Roots.hpp"
#include "atrapos/taylor/Trigonometric.hpp"
