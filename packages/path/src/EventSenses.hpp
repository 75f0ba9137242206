#pragma once

#include <vector>

#include "atrapos/path/Polynomial.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos::path {

struct PathUnderWay;

/// Event function i without its value at the start where that is a known root (one of `zero`).
Polynomial eventPolynomial(const Series& series, int i, const std::vector<int>& zero);

/// max |c_k| a^k over k >= 1, and over the last two of these: those of even and odd functions vanish in turn.
double largestTerm(const std::vector<double>& coefficients, double a);
double lastTerms(const std::vector<double>& coefficients, double a);

/// Whether the terms of a function tell what it is at a but for this part of its size: the later ones are not
/// the largest there, and the last two within that part.
bool converges(const std::vector<double>& coefficients, double a, double part);
/// How large its terms are up to a, as far as they converge.
double sizeOfTerms(const std::vector<double>& coefficients, double a);

/// The candidates that fall along the series in this sense (+1, -1), ascending. A break falls where the
/// series leaves its piece. `flat`: those whose functions begin with their second derivatives, ascending.
std::vector<int> falling(const PathUnderWay& path, const Series& series, const std::vector<int>& candidates,
                         double sense, const std::vector<int>& flat = {});

/// Functions that are below zero at the start of the series by what the residual bound allows, and fall.
std::vector<int> overdue(const PathUnderWay& path, const Series& series);

}  // namespace atrapos::path
