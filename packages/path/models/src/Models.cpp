#include "atrapos/models/Models.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "Registry.hpp"

namespace atrapos::models {

namespace {

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> list;
    for (auto& part : {folds(), bifurcations(), structures()})
      list.insert(list.end(), part.begin(), part.end());
    std::sort(list.begin(), list.end(), [](const Entry& x, const Entry& y) { return x.name < y.name; });
    return list;
  }();
  return all;
}

template <class Range, class Name>
std::string listed(const Range& range, Name name) {
  std::string text;
  for (const auto& x : range) text += (text.empty() ? "" : ", ") + name(x);
  return text;
}

const Entry& entry(const std::string& name) {
  for (const Entry& e : entries())
    if (e.name == name) return e;
  throw std::invalid_argument("model problems: there is no '" + name + "', only " +
                              listed(entries(), [](const Entry& e) { return e.name; }));
}

Parameters complete(const Entry& e, const Parameters& given) {
  Parameters values = e.defaults;
  for (const auto& [key, value] : given) {
    const auto it = values.find(key);
    if (it == values.end())
      throw std::invalid_argument("model problem '" + e.name + "': no parameter '" + key + "', only " +
                                  listed(e.defaults, [](const auto& p) { return p.first; }));
    if (!std::isfinite(value))
      throw std::invalid_argument("model problem '" + e.name + "': " + key + " is not a finite number");
    it->second = value;
  }
  return values;
}

}  // namespace

int count(const Parameters& values, const std::string& name, int least, int most) {
  const double value = values.at(name);
  if (value == std::floor(value) && value >= least && value <= most) return static_cast<int>(value);
  std::ostringstream text;
  text << "model problems: " << name << " = " << value << ", must be an integer from " << least << " to "
       << most;
  throw std::invalid_argument(text.str());
}

double positive(const Parameters& values, const std::string& name) {
  const double value = values.at(name);
  if (value > 0) return value;
  std::ostringstream text;
  text << "model problems: " << name << " = " << value << ", must be positive";
  throw std::invalid_argument(text.str());
}

path::RCP<path::Vector> vector(const path::Problem& problem, const std::vector<double>& x) {
  auto v = Teuchos::rcp(new path::Vector(problem.map()));
  for (std::size_t i = 0; i < x.size(); ++i) v->replaceLocalValue(i, x[i]);
  return v;
}

Monitor unknown(const path::Problem& problem, const std::string& name, int i) {
  auto weights = vector(problem);
  weights->replaceLocalValue(i, 1.0);
  return {name, weights};
}

std::function<double(const path::State&)> zeroUnknowns(std::vector<int> which) {
  return [which = std::move(which)](const path::State& state) {
    const auto u = state.u->getData();
    double worst = 0;
    for (const int i : which) worst = std::max(worst, std::abs(u[i]));
    return worst;
  };
}

void stopAt(Setup& setup, const Monitor& monitor, double value) {
  setup.stops.functionals.push_back({monitor.name, monitor.weights, value});
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const Entry& e : entries()) list.push_back(e.name);
  return list;
}

Parameters parameters(const std::string& name) { return entry(name).defaults; }

std::unique_ptr<path::Problem> make(const std::string& name, const Parameters& parameters) {
  const Entry& e = entry(name);
  return e.make(complete(e, parameters));
}

Setup setup(const std::string& name, const Parameters& parameters, const path::Problem& problem) {
  const Entry& e = entry(name);
  Setup s;
  s.about = e.about;
  s.start = {vector(problem), 0};
  e.setup(complete(e, parameters), problem, s);
  return s;
}

}  // namespace atrapos::models
