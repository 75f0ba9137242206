#pragma once

#include <array>
#include <iosfwd>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/fem/StructuredShell.hpp"

/// The deck: the input of the `atrapos` command, as plain data. docs/deck.md explains every key.
/// Units are the user's own, consistent ones; "force", "length", "pressure" below mean those.
namespace atrapos::deck {

/// What is wrong with a deck, in one line: deck file, key path, problem, what would be accepted.
class DeckError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using Vector3 = std::array<double, 3>;

// ---------------------------------------------------------------------------------------------- mesh

/// How `atrapos mesh` makes the mesh file.
using Generate = std::variant<fem::BoxOptions, fem::StripOptions, fem::CylinderPanelOptions,
                              fem::SpherePanelOptions, fem::ShellPlateOptions, fem::ShellCylinderOptions,
                              fem::ShellAnnulusOptions, fem::ShellSphereOptions>;

struct MeshInput {
  std::string file;  ///< as written in the deck
  std::string path;  ///< the same, relative names resolved against the deck's folder
  std::optional<Generate> generate;
};

// -------------------------------------------------------------------------------- materials, supports

struct SaintVenantKirchhoff {
  double youngsModulus = 0;  ///< pressure, > 0
  double poissonsRatio = 0;  ///< in (-1, 0.5)
};

struct Material {
  std::string name;
  std::variant<SaintVenantKirchhoff> law;
  std::vector<std::string> blocks;  ///< names or ids
};

/// The thickness of the shells of some blocks; those without an entry have it in their attributes.
struct ShellSection {
  std::string name;
  std::vector<std::string> blocks;  ///< names or ids
  std::optional<double> thickness;  ///< length, > 0; empty = the attributes of the blocks
};

struct Shells {
  double foldAngle = 20;  ///< degrees, in (0, 180): beyond it faces at a node have directors of their own
  std::vector<ShellSection> sections;
};

/// Where in the thickness of shells something acts; middle for all others.
enum class ShellPlace { Top, Middle, Bottom };

/// A prescribed displacement component: value + loadFactor * perLoadFactor.
struct Prescribed {
  double value = 0;
  double perLoadFactor = 0;
};

struct Support {
  /// What holds at zero: clamped all of v and w, hinged v, symmetry that component of both.
  enum class Condition { None, Clamped, Hinged, SymmetryX, SymmetryY, SymmetryZ };
  std::string name;
  std::string set;  ///< node set, else side set; name or id
  /// The condition's components are in the two lists below already.
  Condition condition = Condition::None;
  std::array<std::optional<Prescribed>, 3> components{};  ///< x, y, z; empty = free
  /// x, y, z of the displacement w of the directors of shells at these nodes; empty = free
  std::array<std::optional<Prescribed>, 3> director{};
};

/// Whether a condition holds this component (0, 1, 2) of the displacement, or of the director's displacement.
bool holds(Support::Condition condition, std::size_t axis, bool director);

// ---------------------------------------------------------------------------------------------- loads

/// Forces on the nodes of a set.
struct NodalLoad {
  std::string set;       ///< node set, else side set
  bool perNode = false;  ///< force acts on every node; otherwise it is the total, spread equally
  Vector3 force{};
};

/// A load on a side set; areas and normals are those of the reference configuration, unless it follows.
struct SurfaceLoad {
  enum class Kind {
    Total,     ///< vector = resultant force, spread uniformly over the area
    Traction,  ///< vector = force per area
    Pressure   ///< -pressure times the outward normal, per area
  };
  std::string set;
  Kind kind = Kind::Total;
  Vector3 vector{};
  double pressure = 0;    ///< > 0 pushes on the body
  bool follower = false;  ///< pressure only: on the deformed area, along its normal
  ShellPlace at = ShellPlace::Middle;
};

/// A load on the edges of shells in a side set, along the middle surface; lengths are those of the reference
/// configuration.
struct EdgeLoad {
  enum class Kind {
    Total,          ///< vector = resultant force, spread uniformly over the length; dead
    Force,          ///< vector = force per length; dead
    Moment,         ///< vector = moment per length; dead, not about the director
    FollowerForce,  ///< vector = force per length along the edge, outwards, along the director; turns with
                    ///< them
    FollowerMoment  ///< moment = moment per length about the edge; turns with it
  };
  std::string set;
  Kind kind = Kind::Total;
  Vector3 vector{};
  double moment = 0;  ///< > 0 turns the directors outwards: tension on top
};

/// Force per reference volume.
struct VolumeLoad {
  std::vector<std::string> blocks;
  Vector3 force{};
};

struct Load {
  std::string name;
  bool constant = false;  ///< not multiplied by the load factor
  std::variant<NodalLoad, SurfaceLoad, VolumeLoad, EdgeLoad> load;
};

// ------------------------------------------------------------------------------------ tools, contact

/// On which side of a closed tool the body is.
enum class Side { Outside, Inside };

struct CylinderTool {
  Vector3 center{};  ///< any point of the axis
  Vector3 axis{};    ///< direction, not zero, any length
  double radius = 0;
  Side side = Side::Outside;
};

struct SphereTool {
  Vector3 center{};
  double radius = 0;
  Side side = Side::Outside;
};

struct ConeTool {
  Vector3 apex{};
  Vector3 axis{};        ///< from the apex into the cone, not zero, any length
  double halfAngle = 0;  ///< degrees, in (0, 90)
  Side side = Side::Outside;
};

struct TorusTool {
  Vector3 center{};
  Vector3 axis{};         ///< direction, not zero, any length
  double radius = 0;      ///< of the tube's centre line
  double tubeRadius = 0;  ///< < radius
  Side side = Side::Outside;
};

/// Cylinder that turns into a cone at the distance `flat` from the centre, with a smoothed vertex.
struct TaperedRollTool {
  enum class Ends { Both, One };
  Vector3 center{};      ///< on the axis, in the middle of the flat part
  Vector3 axis{};        ///< direction, not zero, any length; with one end: to the end that tapers
  double radius = 0;     ///< of the flat part
  double flat = 0;       ///< length of the flat part from the centre
  double angle = 0;      ///< degrees, in (-90, 90); > 0: the roll narrows
  double smoothing = 0;  ///< width of the vertex, a length
  Ends ends = Ends::Both;
};

/// Roll whose radius is a polynomial of the place along the axis, or goes through a table.
struct CrownedRollTool {
  Vector3 center{};                  ///< on the axis, where the place is 0
  Vector3 axis{};                    ///< direction, not zero, any length
  std::vector<double> coefficients;  ///< of the powers 0, 1, ... of the place; else
  std::vector<double> places;        ///< ascending, and
  std::vector<double> radii;
};

struct PlaneTool {
  Vector3 point{};
  Vector3 normal{};  ///< to the free side, not zero, any length
};

struct Tool {
  std::string name;
  std::variant<CylinderTool, PlaneTool, SphereTool, ConeTool, TorusTool, TaperedRollTool, CrownedRollTool>
      surface;
};

/// Contact of a set with a tool by R (R/alpha + h) = eta (Delta - h), eq. (15) of the paper.
struct Contact {
  enum class Points {
    Nodes,      ///< R, eta: force at each node; alpha: force per length
    Quadrature  ///< R, eta: pressure; alpha: pressure per length
  };
  std::string name;
  std::string tool;
  std::string set;  ///< side set; with nodes: node set, else side set
  Points points = Points::Quadrature;
  ShellPlace at = ShellPlace::Middle;  ///< of shells
  int quadratureDegree = 4;            ///< polynomial degree integrated exactly; unused with nodes
  std::optional<double> stiffness;     ///< alpha > 0; empty = rigid, 1/alpha = 0
  double regularisation = 0;           ///< eta > 0
  std::optional<double> referenceGap;  ///< Delta > eta/alpha; empty = each point's own initial gap
};

// ----------------------------------------------------------------------------------------------- path

/// The path ends at whichever comes first; a deck gives at least one.
struct Stop {
  std::optional<double> loadFactor;
  int steps = 1000;
  std::optional<double> pathLength;
  std::map<std::string, double> displacement;  ///< name of a displacement monitor -> value
};

struct Path {
  int order = 20;          ///< K, 1..60
  double accuracy = 1e-6;  ///< delta of eq. (36)
  double residual = 1e-6;  ///< bound of the relative residual
  int direction = 1;       ///< sign of the load factor's first change
  Stop stop;
};

struct Solver {
  enum class Type { Mumps, Amesos2 };
  Type type = Type::Mumps;
  std::string name;  ///< Amesos2's own name of a solver, e.g. klu2; empty with MUMPS
  /// As linear::makeTangentSolver takes it: "mumps" or "amesos2:<name>".
  std::string spec() const { return type == Type::Mumps ? "mumps" : "amesos2:" + name; }
};

// --------------------------------------------------------------------------------------------- output

enum class OutputField {
  Displacement,
  Stress,       ///< Cauchy stress, element means
  NodalStress,  ///< the same taken from the cubature points to the nodes and averaged there
  Contact,
  Reaction
};
enum class Component { X, Y, Z, Normal };

struct DisplacementMonitor {
  enum class Reduce { Mean, Sum };
  std::string set;  ///< node set, else side set
  Component component = Component::X;
  Reduce reduce = Reduce::Mean;  ///< over the set's nodes
};

/// Total contact force on the tool's side of a contact: the sum of the normal forces, or a component of the
/// resultant that acts on the body. With `near` the normal force (of faces: the pressure times the cubature
/// weight) of the one point that is nearest to a place in the reference configuration.
struct ContactForceMonitor {
  std::string contact;
  Component component = Component::Normal;
  std::optional<Vector3> near;
};

/// Total force with which a support holds the body.
struct ReactionMonitor {
  std::string support;
  Component component = Component::X;
};

struct Monitor {
  std::string name;
  std::variant<DisplacementMonitor, ContactForceMonitor, ReactionMonitor> quantity;
};

struct Output {
  /// What the result file has of shells: their middle surfaces, or solids with their thickness.
  enum class Shells { Surface, Body };
  int pointsPerStep = 5;            ///< states written per step, its end included
  std::vector<OutputField> fields;  ///< never empty after readDeck
  Shells shells = Shells::Surface;
  std::vector<Monitor> monitors;
};

// ----------------------------------------------------------------------------------------------- deck

struct Deck {
  std::string file;  ///< as named by the caller; begins every message
  std::string text;  ///< the whole file, for the result file's info records
  std::string title;
  MeshInput mesh;
  std::vector<Material> materials;  ///< all entries in the deck's order
  Shells shells;
  std::vector<Support> supports;
  std::vector<Load> loads;
  std::vector<Tool> tools;
  std::vector<Contact> contacts;
  Path path;
  Solver solver;
  Output output;
};

/// Reads and validates a whole deck. Throws DeckError for the first thing that is wrong.
Deck readDeck(const std::string& file);

/// The same for a deck in memory; `file` names it in messages and gives the folder of relative file names.
Deck readDeckText(const std::string& text, const std::string& file);

/// Checks every block and set name against the mesh, that each block of the mesh has exactly one material,
/// and that what is meant for shells has shells. Throws DeckError, naming what the mesh has.
void checkAgainstMesh(const Deck& deck, const fem::Mesh& mesh);

/// Prints the effective values, defaults included, as a deck that reads back to the same values.
void describe(const Deck& deck, std::ostream& out);

/// Prints every key with what it accepts, its default and its meaning, one line each.
void describeKeys(std::ostream& out);

}  // namespace atrapos::deck
