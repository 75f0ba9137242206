// Input files with changes at random: each is read, or refused with one line, all in one process.
#include <gtest/gtest.h>

#include <optional>

#include "InpFile.hpp"
#include "TextMutants.hpp"
#include "TextMutator.hpp"
#include "deck/Deck.hpp"

namespace atrapos::importer {
namespace {

/// Something of all that is read.
const std::string
    kBase =
        "*HEADING\nAll that is read\n*NODE, "
        "NSET=all\n1\n2,1.\n3,1.,1.\n4,,1.\n5,0,0,1.\n6,1.,0,1.\n7,1.,1.,1.\n8,0,1.,1.\n9,2.,0.\n10,2.,1.\n"
        "11,2.,0,1.\n12,2.,1.,1.\n*ELEMENT, TYPE=C3D8, ELSET=left\n1, 1,2,3,4,5,\n6,7,8\n*ELEMENT, "
        "TYPE=C3D8I, ELSET=right\n2, 2,9,10,3,6,11,12,7\n"
        "*ELEMENT, TYPE=B31, ELSET=bars\n3, 1, 2\n*ELSET, ELSET=both\nleft, right\n*NSET, NSET=foot, "
        "GENERATE\n1, 4, 1\n*NSET, NSET=end, ELSET=right\n"
        "*SURFACE, NAME=top\nboth, S2\n*SURFACE, NAME=skin\nleft,\n*SURFACE, NAME=n, TYPE=NODE\nfoot, "
        "1.\n*MATERIAL, NAME=steel\n*ELASTIC\n2.1d5, .3\n"
        "*DENSITY\n7.8e-9\n*MATERIAL, NAME=rubber\n*HYPERELASTIC, MOONEY-RIVLIN\n.5, .1, .02\n*SOLID "
        "SECTION, ELSET=left, MATERIAL=steel\n"
        "*SOLID SECTION, ELSET=right, MATERIAL=rubber\n*BOUNDARY\nfoot, 1, 3\n9, ENCASTRE\n*STEP, NLGEOM, "
        "INC=50\n*STATIC, RIKS\n.1, 1., , , 2., 12, 3, -1.\n"
        "*CLOAD\n12, 3, -1.\nend, 2, .5\n*DLOAD\nleft, P2, 2.\nboth, BZ, -1.\nleft, GRAV, 9.81, 0, 0, "
        "-1\n*DSLOAD\ntop, P, 1.\n*BOUNDARY\n11, 1, 1, .1\n"
        "*NODE PRINT, NSET=all\nU\n*END STEP\n",
    kShells =
        "*NODE\n1\n2,1\n3,1,1\n4,0,1\n5,.5\n6,1,.5\n7,.5,1\n8,0,.5\n*ELEMENT, TYPE=S8R, ELSET=p\n1, "
        "1,2,3,4,5,6,7,8\n*MATERIAL, NAME=m\n*ELASTIC\n1, .3\n"
        "*SHELL SECTION, ELSET=p, MATERIAL=m\n.1\n*BOUNDARY\n1, ENCASTRE\n4, XSYMM\n8, 1, "
        "4\n*STEP\n*BUCKLE\n3\n*DLOAD\np, P, 2.\n*END STEP\n",
    kPlane =
        "*NODE\n1\n2,1\n3,1,1\n4,0,1\n*ELEMENT, TYPE=CPS4, ELSET=p\n1, 1,2,3,4\n*MATERIAL, "
        "NAME=m\n*ELASTIC\n1, .3\n*SOLID SECTION, ELSET=p, MATERIAL=m\n.1\n"
        "*BOUNDARY\n1, 1, 2\n4, 1\n*STEP\n*STATIC\n*DLOAD\np, P2, 2.\n*END STEP\n",
    kTied =
        "*NODE\n1\n2,1\n3,1,1\n4,0,1\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n21,0,0,1\n22,1,0,1\n23,1,1,1\n24,0,"
        "1,1\n"
        "25,0,0,2\n26,1,0,2\n27,1,1,2\n28,0,1,2\n99,.5,.5,3\n98,.5,.5,3\n*ELEMENT, TYPE=C3D8, ELSET=c\n1, "
        "1,2,3,4,5,6,7,8\n2, 21,22,23,24,25,26,27,28\n*SURFACE, NAME=lower\n1, S2\n*SURFACE, NAME=upper\n2, "
        "S1\n*NSET, NSET=head\n25, 26, 27, 28\n*TIE, NAME=t\nupper, lower\n*MATERIAL, NAME=m\n*ELASTIC\n2e5, "
        ".3\n*PLASTIC\n250., 0.\n280., .01\n300., .05\n310., .1\n*SOLID SECTION, ELSET=c, MATERIAL=m\n"
        "*RIGID BODY, NSET=head, REF NODE=99, ROT NODE=98\n*BOUNDARY\n1, 1, 3\n2, 2, 3\n4, "
        "3\n*STEP\n*STATIC\n"
        "*BOUNDARY\n99, 1, 2\n*CLOAD\n99, 3, -1.\n*END STEP\n";

TEST(InpMutants, AreReadOrRefusedWithOneLine) {
  const std::vector<std::string> bases{kBase, kShells, kPlane, kTied};
  for (const std::string& base : bases)
    deck::readDeckText("mesh: {file: m.exo}\n" + readText(base, Deck::yes).deck, "m.yaml");
  test::TextMutator mutate(test::inp(), 20);
  const InpFile file("");
  test::TextMutants mutants(3000);
  mutants.tryAll(
      "input files", [&](int) { return mutate(bases[mutate.below(bases.size())]); },
      [&](int m, const std::string& text, std::optional<std::string>& line) {
        file.beside("model.inp", text);
        try {
          const Model model = readInp(file.path(), m % 2 == 0 ? Deck::yes : Deck::no);
          ASSERT_GT(model.mesh.numElements(), 0);
          for (const std::string& remark : model.remarks)
            ASSERT_EQ(remark.find('\n'), std::string::npos) << remark;
          // What no law or deck can take is refused there; nothing else may be wrong with what was written.
          if (!model.deck.empty()) deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, file.path());
        } catch (const Error& e) {
          line = e.what();
          ASSERT_EQ(line->rfind(file.path(), 0), 0u) << *line;
        } catch (const deck::DeckError& e) {
          line = e.what();
        }
      });
  EXPECT_GT(mutants.read(), mutants.number() / 10);
  EXPECT_GT(mutants.refused(), mutants.number() / 10);
}

}  // namespace
}  // namespace atrapos::importer
