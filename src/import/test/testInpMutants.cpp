// Input files with changes at random: each is read, or refused with one line, all in one process.
// ATRAPOS_MUTANTS asks for more of them (scripts/fuzz).
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>

#include "InpFile.hpp"
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
        "*BOUNDARY\n1, 1, 2\n4, 1\n*STEP\n*STATIC\n*DLOAD\np, P2, 2.\n*END STEP\n";

TEST(InpMutants, AreReadOrRefusedWithOneLine) {
  const char* const asked = std::getenv("ATRAPOS_MUTANTS");
  const int mutants = asked != nullptr ? std::atoi(asked) : 3000;
  const std::vector<std::string> bases{kBase, kShells, kPlane};
  for (const std::string& base : bases)
    deck::readDeckText("mesh: {file: m.exo}\n" + readText(base, Deck::yes).deck, "m.yaml");
  test::TextMutator mutate(test::inp(), 20);
  const InpFile file("");
  int read = 0, refused = 0;
  double slowest = 0;
  for (int m = 0; m < mutants; ++m) {
    const std::string text = mutate(bases[mutate.below(bases.size())]);
    file.beside("model.inp", text);
    const auto start = std::chrono::steady_clock::now();
    try {
      const Model model = readInp(file.path(), m % 2 == 0 ? Deck::yes : Deck::no);
      ASSERT_GT(model.mesh.numElements(), 0);
      for (const std::string& remark : model.remarks)
        ASSERT_EQ(remark.find('\n'), std::string::npos) << remark;
      // What no law or deck can take is refused there; nothing else may be wrong with what was written.
      if (!model.deck.empty()) deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, file.path());
      ++read;
    } catch (const Error& e) {
      const std::string line = e.what();
      ASSERT_EQ(line.find('\n'), std::string::npos) << line << "\n" << text;
      ASSERT_EQ(line.rfind(file.path(), 0), 0u) << line;
      ++refused;
    } catch (const deck::DeckError& e) {
      ASSERT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      ++refused;
    } catch (const std::exception& e) {
      FAIL() << "mutant " << m << ": " << e.what() << "\n" << text;
    }
    slowest =
        std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  EXPECT_LT(slowest, 10);
  EXPECT_GT(read, mutants / 10);
  EXPECT_GT(refused, mutants / 10);
  std::cout << mutants << " mutants: " << read << " read, " << refused << " refused, the slowest in "
            << slowest << " s\n";
}

}  // namespace
}  // namespace atrapos::importer
