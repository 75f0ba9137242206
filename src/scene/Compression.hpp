#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// What a deck asks of Saint Venant-Kirchhoff bodies in which that law is off by more than a quarter:
/// compression by more than a tenth between two supports, or by a pressure of more than a tenth of Young's
/// modulus, at the largest load factor that it stops at (1 where it stops at none). A line for each,
/// "supports/right: ..."; empty: nothing. What other loads, contact and bending do is not foreseen.
std::vector<std::string> largeCompression(const deck::Deck& deck, const fem::Mesh& mesh);

}  // namespace atrapos
