#include "import/Import.hpp"
#include "import/InpDeck.hpp"
#include "import/InpMesh.hpp"
#include "import/InpModel.hpp"
#include "import/InpStep.hpp"

namespace atrapos::importer {

Model readInp(const std::string& file, Deck deck) {
  const InpSource source(file);
  InpModel model = readInpModel(source);
  Model result;
  if (deck == Deck::yes) {
    const InpStep step = readInpStep(model);
    InpMesh mesh(model, inpCuts(step));
    result.deck = inpDeck(model, step, mesh);
    result.mesh = std::move(mesh.mesh);
  } else {
    result.mesh = InpMesh(model, {}).mesh;
  }
  result.remarks = std::move(model.remarks);
  if (model.moreRemarks > 0)
    result.remarks.push_back(file + ": and " + std::to_string(model.moreRemarks) + " lines more like these");
  return result;
}

}  // namespace atrapos::importer
