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

std::vector<double> FieldSizes::factors(double w) const {
  if (sizes_.empty() || !(w > 0)) return {};
  const auto load = sizes_.end() - 1;
  const auto count = std::count_if(sizes_.begin(), load, [](double s) { return s > 0; });
  if (count < 2 || !(*load > 0)) return {};
  const double each = std::pow(coarse(*load), 2) / (w * static_cast<double>(count));
  std::vector<double> factors;
  for (auto s = sizes_.begin(); s != load; ++s)
    factors.push_back(*s > 0 ? each / std::pow(coarse(*s), 2) : 1);
  return factors;
}

}  // namespace atrapos::path
