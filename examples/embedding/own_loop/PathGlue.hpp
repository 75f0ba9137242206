#pragma once
#include "Host.hpp"
#include "atrapos/path/Problem.hpp"
#include "atrapos/taylor/PointSeries.hpp"

/// The host's application as a path::Problem.
class PathGlue : public atrapos::path::Problem {
 public:
  explicit PathGlue(host::Application& app) : app_(app), series_(app.element(), app.numElements()) {}

  Teuchos::RCP<const host::Map> map() const override { return app_.map(); }

  atrapos::path::ResidualNorm residual(const atrapos::path::State& at, host::Vector& r) override {
    app_.residual(*at.u, at.lambda, r);
    return {r.norm2(), app_.forceScale()};
  }
  Teuchos::RCP<const host::Matrix> tangent(const atrapos::path::State& at, host::Vector& F) override {
    return app_.jacobian(*at.u, at.lambda, F);
  }
  void beginSeries(const atrapos::path::State& at, int maxOrder) override {
    app_.import(*at.u, at.lambda);
    series_.begin(maxOrder, [&](int e, double* in) { app_.gather(e, in); });
  }
  void orderRhs(int k, host::Vector& Fk) override {
    app_.clearForces();
    series_.order(
        k, [&](int e, double* in) { app_.gather(e, in); },
        [&](int e, const double* out) { app_.scatter(e, out, -1); });
    app_.exportForces(Fk);
  }
  void completeOrder(int, const host::Vector& Uk, double lambdaK) override { app_.import(Uk, lambdaK); }

 private:
  host::Application& app_;
  atrapos::taylor::PointSeries<host::BratuElement> series_;
};
