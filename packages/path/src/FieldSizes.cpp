#include "FieldSizes.hpp"

#include <algorithm>
#include <cmath>

namespace atrapos::path {

namespace {

/// A power of two near the size: of two runs that round differently both take the same, but by an accident
/// for which a size has to be an odd number.
double coarse(double size) {
  constexpr double odd = 0.3819660112501051;
  return std::exp2(std::floor(std::log2(size) + odd));
}

}  // namespace

void FieldSizes::moved(std::vector<double> fields, double lambda) {
  if (fields.empty()) return;
  fields.push_back(lambda);
  sizes_.resize(fields.size(), 0.0);
  for (std::size_t f = 0; f < fields.size(); ++f)
    if (std::isfinite(fields[f])) sizes_[f] = std::max(sizes_[f], std::abs(fields[f]));
}

long FieldSizes::numMoved() const {
  return sizes_.empty() ? 0 : std::count_if(sizes_.begin(), sizes_.end() - 1, [](double s) { return s > 0; });
}

std::vector<double> FieldSizes::factors(double w) const {
  // One that is at rest may be what a branch begins with: it keeps its numbers.
  return numMoved() < 2 ? std::vector<double>() : factors(w, 1);
}

std::vector<double> FieldSizes::factorsOfMoved(double w) const {
  return numMoved() < 1 ? std::vector<double>() : factors(w, 0);
}

std::vector<double> FieldSizes::factors(double w, double atRest) const {
  const auto load = sizes_.end() - 1;
  if (!(w > 0 && *load > 0)) return {};
  const double each = std::pow(coarse(*load), 2) / (w * static_cast<double>(numMoved()));
  std::vector<double> factors;
  for (auto s = sizes_.begin(); s != load; ++s)
    factors.push_back(*s > 0 ? each / std::pow(coarse(*s), 2) : atRest);
  return factors;
}

}  // namespace atrapos::path
