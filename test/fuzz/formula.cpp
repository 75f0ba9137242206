// A formula of a deck, in each of the places where one may stand; what depends on the place alone is
// evaluated.
#include "Target.hpp"
#include "atrapos/physics/Formulas.hpp"

using namespace atrapos;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::textOf(data, size);
  const std::vector<std::string> fields{"T", "phi"};
  const physics::Constants constants{{"k", 2.5}, {"zero", 0}};
  for (const auto place : {physics::Place::body, physics::Place::surface, physics::Place::reference}) {
    try {
      physics::checkFormula(text, place == physics::Place::reference ? std::vector<std::string>{} : fields,
                            constants, place);
      if (place == physics::Place::reference)
        for (const double x : {0.0, 0.5, -1e300}) {
          const double position[] = {x, 1, -x};
          physics::ofPlace(text, constants)(position);
        }
      else
        physics::dependsOnLoadFactor(text, fields, constants, place);
    } catch (const formula::FormulaError& error) {
      fuzz::requireOneLine(error.what(), "");
    }
  }
  return 0;
}
