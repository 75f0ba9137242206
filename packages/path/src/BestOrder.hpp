#pragma once

namespace atrapos::path {

/// The order K in [5, 40] of least cost per length of path, (F + K S) / delta^(1/(K-1)), with F the seconds
/// of a factorization, S those of one order (right-hand side and solve): near (K-1)^2 = ln(1/delta) (F/S +
/// K).
int bestOrder(double factorSeconds, double orderSeconds, double delta);

}  // namespace atrapos::path
