#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/physics/Formulas.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "atrapos/solid/ShellPoints.hpp"

/// Balances of scalar fields whose coefficients are formulas (docs/theory/balance.md): conduction of heat and
/// current, reaction and diffusion.
namespace atrapos::physics {

/// capacity dfield/dt - div(conductivity grad field) = source, of which a path follows the steady states.
struct Balance {
  std::string field;
  std::string conductivity = "0";
  std::string source = "0";
  std::string capacity{};  ///< empty: not said; 1 where no balance of the field says it
};

/// conductivity dfield/dn = amount, per area.
struct Inflow {
  std::string field;
  std::string amount = "0";
};

/// One component without a name, of a balance of its own.
fem::Field scalarField(const std::string& name);

/// Terms of a block and of the sides of a set, whose nodes have these fields, at most mostFields; what is
/// said of one field more than once adds up. `plane`: of plane cells; `shells`: of the elements of a block of
/// shells; nothing is said of what has no balance.
/// Throw std::invalid_argument for other numbers of fields, std::runtime_error for cells as the points do.
std::unique_ptr<fem::Term> balanceTerm(const fem::Mesh& mesh, const fem::Block& block,
                                       const std::vector<std::string>& fields,
                                       const std::vector<Balance>& balances, const Constants& constants,
                                       const std::optional<solid::PlaneSection>& plane,
                                       const solid::ShellElements* shells = nullptr);
std::vector<std::unique_ptr<fem::Term>> inflowTerms(const fem::Mesh& mesh, const fem::SideSet& set,
                                                    const std::vector<std::string>& fields,
                                                    const std::vector<Inflow>& inflows,
                                                    const Constants& constants,
                                                    const std::optional<solid::PlaneSection>& plane);

/// The stage ContactInflow of an amount that also knows contact_pressure and contact_gap. Throws
/// formula::FormulaError, and std::invalid_argument for more than mostFields.
std::unique_ptr<fem::PointLaw> contactInflow(const std::string& amount,
                                             const std::vector<std::string>& fields,
                                             const Constants& constants);

}  // namespace atrapos::physics
