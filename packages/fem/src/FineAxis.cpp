#include "FineAxis.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace atrapos::fem {
namespace {

/// q + q^2 + ... + q^m.
double powers(double q, int m) {
  double sum = 0;
  for (int i = 0; i < m; ++i) sum = q * (1 + sum);
  return sum;
}

std::string text(double x) {
  std::string s = std::to_string(x);
  s.erase(s.find_last_not_of('0') + 1);
  if (s.back() == '.') s.pop_back();
  return s;
}

}  // namespace

double growth(const FineEnd& fine, double length, int divisions) {
  const int beside = divisions - fine.divisions;
  if (!(fine.length > 0 && fine.length < length))
    throw std::invalid_argument("fine elements over " + text(fine.length) + " of a length of " +
                                text(length) + ": must be above 0 and below it");
  if (fine.divisions < 1 || beside < 1)
    throw std::invalid_argument(std::to_string(fine.divisions) + " fine elements of " +
                                std::to_string(divisions) + ": must be at least 1, and leave at least 1");
  const double wanted = (length - fine.length) / (fine.length / fine.divisions);
  // A mesh of equal elements is one too, but for rounding.
  constexpr double rounding = 1e-12;
  if (wanted < beside * (1 - rounding))
    throw std::invalid_argument(
        std::to_string(beside) + " elements beside " + std::to_string(fine.divisions) + " fine ones of " +
        text(fine.length / fine.divisions) + " would be smaller than these: " + text(length - fine.length) +
        " is left for them");
  double low = 1, high = std::max(1.0, wanted);  // powers(q, m) >= q
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return low;
    (powers(middle, beside) < wanted ? low : high) = middle;
  }
}

FineAxis::FineAxis(const FineEnd& fine, double length, int divisions) {
  if (fine.divisions == 0) return;
  const double q = growth(fine, length, divisions);
  double size = fine.length / length / fine.divisions;
  corners_.push_back(0);
  for (int i = 0; i < divisions; ++i) {
    if (i >= fine.divisions) size *= q;
    corners_.push_back(i + 1 == fine.divisions ? fine.length / length : corners_.back() + size);
  }
  corners_.back() = 1;
  if (!fine.atMax) return;
  std::reverse(corners_.begin(), corners_.end());
  for (double& x : corners_) x = 1 - x;
}

double FineAxis::at(double s) const {
  if (corners_.empty()) return s;
  const double place = 0.5 * std::round(2 * s * static_cast<double>(corners_.size() - 1));
  const auto low = static_cast<std::size_t>(std::floor(place)),
             high = static_cast<std::size_t>(std::ceil(place));
  return 0.5 * (corners_[low] + corners_[high]);
}

}  // namespace atrapos::fem
