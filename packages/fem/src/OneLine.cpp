#include "OneLine.hpp"

#include <algorithm>
#include <cmath>

namespace atrapos::fem {

OneLine::OneLine(const LineLaws& laws, const double* c, double lambda) : laws_(laws), lambda_(lambda) {
  for (int m = 0; m < laws.coefficients(); ++m) c_.insert(c_.end(), L, c[m]);
}

LineProbe OneLine::probeAt(double xi, int preferred) const {
  const std::vector<double> places(L, xi);
  const std::vector<int> pieces(L, preferred);
  return probe(laws_, 1, places.data(), c_.data(), lambda_, pieces.data());
}

OneLine::At OneLine::operator()(double xi, int preferred) const {
  const LineProbe p = probeAt(xi, preferred);
  return {p.gap[0], p.slope[0], p.bend[0], {p.normal[0], p.normal[L], p.normal[2 * L]}};
}

void OneLine::place(double xi, double* x, double* along) const {
  std::fill_n(x, 3, 0.0);
  std::fill_n(along, 3, 0.0);
  x[3] = lambda_;
  for (int k = laws_.degree; k >= 0; --k)
    for (int i = 0; i < 3; ++i) {
      along[i] = along[i] * xi + x[i];
      x[i] = x[i] * xi + c_[(3 * k + i) * L];
    }
}

std::pair<double, double> OneLine::gapAndSlope(double xi) const {
  const int J = laws_.placeInputs();
  double x[4], along[3];
  place(xi, x, along);
  std::vector<double> in(J * L);
  for (int j = 0; j < J; ++j) std::fill_n(&in[j * L], L, x[j]);
  const auto out = laws_.projected(1, in.data());
  if (std::isinf(out[0])) return {out[0], 0.0};
  return {out[0], out[L] * along[0] + out[2 * L] * along[1] + out[3 * L] * along[2]};
}

int OneLine::pieceAt(double xi, int preferred) const {
  double x[4], along[3];
  place(xi, x, along);
  std::vector<double> data(laws_.pieces.numData, 0.0);
  laws_.pieces.update(1, x, &preferred, data.data());
  return static_cast<int>(data[laws_.pieces.piece]);
}

Hold OneLine::borderOf(int piece, double xi) const {
  constexpr double near = 1e-6, alongIt = 1e-6;
  const LineProbe p = probeAt(xi, piece);
  for (int i = 0; i < 2; ++i)
    if (std::abs(std::abs(p.in[i * L]) - 1) < near && std::abs(p.inSlope(i, 0, 0)) > alongIt)
      return i == 0 ? Hold::border1 : Hold::border2;
  return Hold::place;
}

}  // namespace atrapos::fem
