#include "import/Import.hpp"
#include "import/InpDeck.hpp"
#include "import/InpMesh.hpp"
#include "import/InpModel.hpp"
#include "import/InpRigidMotions.hpp"
#include "import/InpStep.hpp"

namespace atrapos::importer {

Model readInp(const std::string& file, Deck deck) {
  const InpSource source(file);
  InpModel model = readInpModel(source);
  Model result;
  if (deck == Deck::yes) {
    InpStep step = readInpStep(model);
    const InpRigidMotions rigid(model, step);
    std::vector<int> more = rigid.references();
    for (const InpEquation& equation : model.equations)
      for (const InpEquation::Term& term : equation.terms)
        more.insert(more.end(), term.nodes.begin(), term.nodes.end());
    InpMesh mesh(model, inpCuts(step), more);
    result.deck = inpDeck(model, step, rigid, mesh);
    result.mesh = std::move(mesh.mesh);
  } else {
    result.mesh = InpMesh(model, {}, {}).mesh;
    if (!model.equations.empty())
      model.remark(model.equations.front().place,
                   "*EQUATION: left out, this one and those behind it are couplings of a deck (--deck)");
  }
  result.remarks = std::move(model.remarks);
  if (model.moreRemarks > 0)
    result.remarks.push_back(file + ": and " + std::to_string(model.moreRemarks) + " lines more like these");
  return result;
}

}  // namespace atrapos::importer
