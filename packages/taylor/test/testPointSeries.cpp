// Series at many points by PointSeries: those of polynomials(), point by point.

#include <gtest/gtest.h>

#include <cmath>

#include "TestLaws.hpp"
#include "atrapos/taylor/PointSeries.hpp"
#include "atrapos/taylor/Polynomial.hpp"

using namespace atrapos::taylor;

namespace {

constexpr int numPoints = 19, maxOrder = 12;  // two full groups of eight lanes and one of three

/// Coefficient k of input j at a point: of no pattern, falling like 0.6^k.
double coefficient(int point, int j, int k) {
  return (k == 0 ? 1.5 : std::pow(0.6, k)) * std::cos(1.0 + point + 2.3 * j + 0.7 * k);
}

/// The orders k as a solver asks for them: out is coefficient k with that of the inputs taken as zero.
template <class Law>
void agreesWithPolynomials(const Law& law, const std::vector<double>& data, double tolerance) {
  PointSeries<Law> series(law, numPoints, data);
  for (int repeat = 0; repeat < 2; ++repeat) {  // the second series in the memory of the first
    series.begin(maxOrder, [&](int point, double* in) {
      for (int j = 0; j < Law::numInputs; ++j) in[j] = coefficient(point, j, 0);
    });
    for (int k = 1; k <= maxOrder; ++k) {
      int visited = 0;
      series.order(
          k,
          [&](int point, double* in) {
            for (int j = 0; j < Law::numInputs; ++j) in[j] = coefficient(point, j, k - 1);
          },
          [&](int point, const double* out) {
            EXPECT_EQ(point, visited++);
            std::vector<Polynomial> in;
            for (int j = 0; j < Law::numInputs; ++j) {
              std::vector<double> c;
              for (int i = 0; i < k; ++i) c.push_back(coefficient(point, j, i));
              c.push_back(0);  // order k is not known
              in.emplace_back(c);
            }
            const auto expected = polynomials(law, in, data.data() + point * Law::numData);
            for (int i = 0; i < Law::numOutputs; ++i) {
              double scale = 1;
              for (const double c : expected[i].coefficients()) scale = std::max(scale, std::abs(c));
              EXPECT_NEAR(out[i], expected[i].coefficients()[k], tolerance * scale) << point << ' ' << k;
            }
          });
      EXPECT_EQ(visited, numPoints);
    }
  }
}

// The same operations in another order: some tens of roundings of terms as large as the largest coefficient.
constexpr double rounding = 1e-13;

TEST(PointSeries, AreThePolynomials) {
  agreesWithPolynomials(SquarePlusExponential{}, {}, rounding);
  agreesWithPolynomials(SaintVenantKirchhoff{}, {}, rounding);
}

/// sqrt(x_0 x_0 + datum): a law with data.
struct Hypotenuse {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    using std::sqrt;
    out[0] = sqrt(in[0] * in[0] + data[0]);
  }
};

TEST(PointSeries, EveryPointHasItsData) {
  std::vector<double> data;
  for (int p = 0; p < numPoints; ++p) data.push_back(3 + p);
  agreesWithPolynomials(Hypotenuse{}, data, rounding);
}

TEST(PointSeries, SaysWhatIsWrong) {
  EXPECT_THROW(PointSeries<Hypotenuse>(Hypotenuse{}, 3, {1, 2}), std::invalid_argument);
  std::vector<double> data(numPoints, 1.0);
  data[17] = -4;
  PointSeries<Hypotenuse> series(Hypotenuse{}, numPoints, data);
  const auto one = [](int, double* in) { in[0] = 1; };
  try {
    series.begin(2, one);
    ADD_FAILURE() << "sqrt of a negative number has no series";
  } catch (const DomainError& error) {
    EXPECT_STREQ(error.what(), "point 17: sqrt of -3: its argument must be positive");
  }
  PointSeries<Hypotenuse> orders(Hypotenuse{}, numPoints, std::vector<double>(numPoints, 1.0));
  orders.begin(2, one);
  EXPECT_THROW(orders.order(2, one, [](int, const double*) {}), std::invalid_argument);
}

}  // namespace
