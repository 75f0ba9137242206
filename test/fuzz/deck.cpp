// The text of a deck: read, or refused with one line. What was read is described by a deck that reads as the
// same.
#include <sstream>

#include "TextTarget.hpp"
#include "deck/Deck.hpp"
#include "deck/ProblemLines.hpp"

using namespace atrapos;

namespace {

std::string described(const deck::Deck& deck) {
  std::ostringstream text;
  deck::describe(deck, text);
  return text.str();
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return fuzz::mutateText(test::yaml(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file = "deck.yaml";
  deck::Deck deck;
  try {
    deck = deck::readDeckText(fuzz::textOf(data, size), file);
  } catch (const deck::DeckError& error) {
    fuzz::requireOneLine(error.what(), file);
    return 0;
  }
  const std::string text = described(deck);
  try {
    const deck::Deck again = deck::readDeckText(text, file);
    if (described(again) != text) fuzz::fail("a described deck is another one:\n" + text + described(again));
    const auto difference = deck::firstDifference(deck::problemLines(deck), deck::problemLines(again));
    if (!difference.empty()) fuzz::fail("a described deck is another one: " + difference);
  } catch (const deck::DeckError& error) {
    fuzz::fail(std::string("a described deck is refused: ") + error.what() + "\n" + text);
  }
  return 0;
}
