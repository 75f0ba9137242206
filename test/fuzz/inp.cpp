// An input file of Abaqus or CalculiX, with and without a deck: a mesh, or one line.
#include "TextTarget.hpp"
#include "deck/Deck.hpp"
#include "import/Import.hpp"

using namespace atrapos;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return fuzz::mutateText(test::inp(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = fuzz::folder().write("model.inp", fuzz::textOf(data, size));
  for (const auto deck : {importer::Deck::no, importer::Deck::yes}) {
    try {
      const importer::Model model = importer::readInp(file, deck);
      if (model.mesh.numElements() == 0) fuzz::fail("a mesh without elements");
      for (const std::string& remark : model.remarks) fuzz::requireOneLine(remark, file);
      if (!model.deck.empty()) deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, file);
    } catch (const importer::Error& error) {
      fuzz::requireOneLine(error.what(), file);
    } catch (const deck::DeckError& error) {
      // What no law can take is refused there.
      fuzz::requireOneLine(error.what(), file);
    }
  }
  return 0;
}
