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
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "atrapos/fem/TrussMesh.hpp"
#include "atrapos/path/BranchOptions.hpp"
#include "atrapos/path/Options.hpp"

/// The deck: the input of the `atrapos` command, as plain data. docs/deck.md explains every key.
/// Units are the user's own, consistent ones; "force", "length", "pressure" below mean those.
namespace atrapos::deck {

/// What is wrong with a deck, in one line: deck file, line and column, key path, problem, what would be
/// accepted.
class DeckError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using Vector3 = std::array<double, 3>;

// ---------------------------------------------------------------------------------------------- mesh

/// How `atrapos mesh` makes the mesh file.
using Generate = std::variant<fem::BoxOptions, fem::StripOptions, fem::CylinderPanelOptions,
                              fem::SpherePanelOptions, fem::ShellPlateOptions, fem::ShellCylinderOptions,
                              fem::ShellAnnulusOptions, fem::ShellSphereOptions, fem::RectangleOptions,
                              fem::AnnulusOptions, fem::QuadrilateralOptions, fem::TrussOptions>;

struct MeshInput {
  std::string file;         ///< as written in the deck
  std::string path;         ///< the same, relative names resolved against the deck's folder
  bool decomposed = false;  ///< read from part files even where the whole file is there
  std::optional<Generate> generate;
};

// -------------------------------------------------------------------------------- materials, supports

struct SaintVenantKirchhoff {
  double youngsModulus = 0;  ///< pressure, > 0
  double poissonsRatio = 0;  ///< in (-1, 0.5)
};

/// Either Young's modulus and Poisson's ratio at rest, or the shear and the bulk modulus.
struct NeoHookean {
  std::optional<double> youngsModulus;  ///< pressure, > 0
  std::optional<double> poissonsRatio;  ///< in (-1, 0.5)
  std::optional<double> shearModulus;   ///< pressure, > 0
  std::optional<double> bulkModulus;    ///< pressure, > 0, or infinite
};

/// Pressures; c1 + c2 > 0, bulkModulus > 0 or infinite.
struct MooneyRivlin {
  double c1 = 0, c2 = 0, bulkModulus = 0;
};

/// Pressures; c1 > 0, bulkModulus > 0 or infinite.
struct Yeoh {
  double c1 = 0, c2 = 0, c3 = 0, bulkModulus = 0;
};

struct Gent {
  double shearModulus = 0;  ///< pressure, > 0
  double limit = 0;         ///< J_m, > 0
  double bulkModulus = 0;   ///< pressure, > 0, or infinite
};

/// One to six terms mu_p, alpha_p, none of them 0; the sum of mu alpha, twice the shear modulus at rest, > 0.
struct Ogden {
  std::vector<double> mu;     ///< pressures
  std::vector<double> alpha;  ///< as many, of at most 40
  double bulkModulus = 0;     ///< pressure, > 0, or infinite
};

/// Plasticity; stresses and moduli are pressures.
struct VonMises {
  enum class Strains { Small, Finite };
  Strains strains = Strains::Small;
  double youngsModulus = 0;     ///< > 0
  double poissonsRatio = 0;     ///< in (-1, 0.5)
  double yieldStress = 0;       ///< in tension, > 0
  double hardeningModulus = 0;  ///< linear isotropic hardening by plastic strain, >= 0
  double saturation = 0;        ///< what Voce's isotropic hardening adds in the end
  double exponent = 0;          ///< of Voce's hardening, by plastic strain, >= 0
  double kinematicModulus = 0;  ///< Armstrong and Frederick, >= 0
  double recall = 0;            ///< of the backstress, >= 0; 0: Prager
  double yieldWidth = 0;        ///< of a smoothed yield surface, a share of its size, 0 to 0.5; 0: sharp
};

/// A field is an electric potential in the material, an ideal dielectric.
struct ElectricField {
  std::string field;
  double permittivity = 0;  ///< > 0
};

struct Material {
  /// Displacements alone, or with pressures as further unknowns.
  enum class Formulation { Displacement, Mixed };
  std::string name;
  std::variant<SaintVenantKirchhoff, NeoHookean, MooneyRivlin, Yeoh, Gent, Ogden, VonMises> law;
  std::vector<std::string> blocks;  ///< names or ids
  Formulation formulation = Formulation::Displacement;
  std::string expansion;  ///< formula: lengths without stress are 1 + it times as large; empty = 0
  std::optional<ElectricField> dielectric;
};

// -------------------------------------------------------------------------- fields and physics of their own

/// A scalar field, where it begins.
struct ScalarField {
  std::string name;
  std::string initial = "0";  ///< formula of x, y, z: at load factor 0, before any correction
};

/// -div(conductivity grad field) = source: formulas of the fields that meet there, lambda, x, y, z.
struct ScalarBalance {
  std::string field;
  std::string conductivity = "0";
  std::string source = "0";
  std::string capacity;  ///< empty: 1
};

/// Steady flow of an incompressible Newtonian fluid; velocities and pressure are scalar fields.
struct FluidFlow {
  std::vector<std::string> velocity;  ///< x, y, z
  std::string pressure;
  double viscosity = 0;  ///< dynamic, > 0
  double density = 1;    ///< >= 0
};

/// A law of a plug-in, for scalar fields.
struct PluginLaw {
  std::string law;
  std::vector<std::string> fields;
  std::map<std::string, double> parameters;
};

/// What acts in some blocks; unknowns exist where something acts on them.
struct Physics {
  std::string name;
  std::variant<ScalarBalance, FluidFlow, PluginLaw> law;
  std::vector<std::string> blocks;  ///< names or ids
};

/// The body that a plane mesh (x, y) stands for.
struct Plane {
  enum class Kind { Strain, Stress, Axisymmetric };
  Kind kind = Kind::Strain;
  std::optional<double> thickness;  ///< length, > 0; empty = 1; not with axisymmetry
};

/// The transverse shear strains of shells.
enum class Shear {
  Compatible,  ///< those of the displacements: the paper's element
  Assumed      ///< tied along lines of the element, which frees thin plates of locking
};

/// The thickness of the shells of some blocks; those without an entry have it in their attributes.
struct ShellSection {
  std::string name;
  std::vector<std::string> blocks;  ///< names or ids
  std::optional<double> thickness;  ///< length, > 0; empty = the attributes of the blocks
  std::optional<Shear> shear;       ///< empty = as Shells has it
};

/// How shells with directors of their own are joined at the nodes of a set.
struct ShellJoint {
  enum class Kind {
    Rigid,  ///< the angles between them stay, moments pass
    Hinge   ///< they share the displacement alone
  };
  std::string name;
  std::string set;  ///< node set, else side set
  Kind kind = Kind::Rigid;
};

struct Shells {
  double foldAngle = 20;  ///< degrees, in (0, 180): beyond it faces at a node have directors of their own
  std::vector<ShellJoint> joints;   ///< rigid where no entry says otherwise; of several the last one counts
  Shear shear = Shear::Compatible;  ///< of blocks without an entry, and of entries without their own
  std::vector<ShellSection> sections;
  int metalPoints = 5;  ///< through the thickness where the material yields, 2 to 10
};

/// Blocks of membranes or of bars, which resist stretching alone.
struct ThinSection {
  std::string name;
  std::vector<std::string> blocks;  ///< names or ids
  double size = 0;                  ///< of membranes the thickness, of bars the area; > 0
  double prestress = 0;             ///< at rest, a pressure
};

/// Where in the thickness of shells something acts; middle for all others.
enum class ShellPlace { Top, Middle, Bottom };

/// A prescribed displacement component: value + loadFactor * perLoadFactor.
struct Prescribed {
  double value = 0;
  double perLoadFactor = 0;
  /// Formulas of x, y, z in place of the numbers; empty: these.
  std::string valueFormula = {}, perLoadFactorFormula = {};

  bool driven() const { return perLoadFactor != 0 || !perLoadFactorFormula.empty(); }
};

struct Support {
  /// What holds at zero: clamped all of v and w, hinged v, symmetry that component of both, along the normal
  /// where it names no axis.
  enum class Condition { None, Clamped, Hinged, SymmetryX, SymmetryY, SymmetryZ, Symmetry };
  std::string name;
  std::string set;  ///< node set, else side set; name or id
  /// The condition's components are in the two lists below already.
  Condition condition = Condition::None;
  std::array<std::optional<Prescribed>, 3> components{};  ///< x, y, z; empty = free
  /// x, y, z of the displacement w of the directors of shells at these nodes; empty = free
  std::array<std::optional<Prescribed>, 3> director{};
  std::string field;                ///< a scalar one, which is held in place of displacements; empty = none
  std::optional<Vector3> normal;    ///< in place of components: the direction of what is held; not zero
  std::optional<Prescribed> value;  ///< of the field, or of the displacement along the normal; empty: 0
  bool released = false;            ///< by a stage: holds nothing any more
};

/// Whether a condition holds this component (0, 1, 2) of the displacement, or of the director's displacement.
bool holds(Support::Condition condition, std::size_t axis, bool director);

/// A term of an equation: factor times an unknown of each node of a set.
struct EquationTerm {
  std::string set;      ///< node set, else side set
  std::string unknown;  ///< x, y, z or a scalar field
  double factor = 1;    ///< not 0
};

/// Nodes of a set that move together.
struct Coupling {
  enum class Kind {
    Equal,         ///< every component as that of the set's first node
    Plane,         ///< a common displacement along `normal`; directors of shells stay in the plane
    Rigid,         ///< a rigid body of finite rotations, directors of shells with it
    ShellOnSolid,  ///< nodes of shells follow the nodes of a solid at the top and bottom of their directors
    Tie,           ///< a surface follows another one, whose mesh need not fit
    Equation       ///< the sum of the terms is 0, for each node of their sets
  };
  std::string name;
  std::string set;  ///< node set, else side set; of a tie a side set; of an equation empty
  Kind kind = Kind::Rigid;
  std::optional<Vector3> normal;    ///< plane only, not zero, any length
  std::string reference;            ///< rigid only, a node set of one node; empty: none
  std::optional<Vector3> axis;      ///< rigid only: the body turns about this direction alone; not zero
  std::optional<Prescribed> angle;  ///< with axis: how far, in degrees, numbers alone; empty: it turns freely
  std::vector<EquationTerm> terms;  ///< equation only, two or more; the first unknown follows from the others
  std::string to;                   ///< tie only, a side set
  std::optional<double> reach;      ///< tie only: of the faces' size, > 0; empty: fem::TieOptions
};

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

/// A moment about the axis of a rigid coupling.
struct MomentLoad {
  std::string coupling;
  double moment = 0;
};

/// What flows of a scalar field into a body per area, through the sides of a set or through a contact.
struct InflowLoad {
  std::string set, contact;  ///< one of them is empty
  std::string field;
  std::string amount;  ///< formula of the fields there, lambda, x, y, z; contact_pressure and contact_gap
};

/// A law of a plug-in on the sides of a set.
struct PluginLoad {
  std::string set;
  PluginLaw law;
};

struct Load {
  std::string name;
  bool constant = false;  ///< not multiplied by the load factor
  std::variant<NodalLoad, SurfaceLoad, VolumeLoad, EdgeLoad, MomentLoad, InflowLoad, PluginLoad> load;
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

/// One Bezier patch (no knots) or one B-spline surface; with weights rational.
struct SplineSurface {
  std::string name;
  std::array<int, 2> degree{1, 1};
  std::vector<Vector3> points;               ///< [i][j], j runs fastest
  std::vector<double> weights;               ///< of the points; empty: all 1
  std::array<std::vector<double>, 2> knots;  ///< count + degree + 1 in each direction
};

/// Parametric surfaces, paper (13), which may continue each other.
struct PatchesTool {
  std::vector<SplineSurface> surfaces;
  std::string file;                 ///< as written in the deck; the surfaces are read from it. Empty: none
  bool reversed = false;            ///< the free side is against S_1 x S_2
  std::optional<double> thickness;  ///< length: deeper points are behind the tool; empty = unlimited
};

/// How a tool moves with the load factor: a turn about an axis through the pivot, then a shift.
struct ToolMotion {
  std::vector<Vector3> shift;  ///< factors of the powers 1, 2, 3 of the load factor, lengths
  std::vector<double> angle;   ///< the same of the angle, degrees
  Vector3 axis{0, 0, 1};       ///< direction, any length
  Vector3 pivot{};
  std::optional<double> heldAt;  ///< a load factor: by a stage, the tool stays where it is there
  bool moves() const { return !shift.empty() || !angle.empty(); }
};

struct Tool {
  std::string name;
  std::variant<CylinderTool, PlaneTool, SphereTool, ConeTool, TorusTool, TaperedRollTool, CrownedRollTool,
               PatchesTool>
      surface;
  ToolMotion motion;
};

/// Contact of a set with a tool: a law between the pressure R and the gap h with R = 0 at h = Delta.
struct Contact {
  enum class Points {
    Auto,        ///< nodes, quadrature or zones, as law, set and scene suggest (scene/ChosenContact.hpp)
    Nodes,       ///< R, eta: force at each node; alpha: force per length
    Quadrature,  ///< R, eta: pressure; alpha: pressure per length
    Zones  ///< the zones of edges where the gap is below zero, up to their limits; alpha as with quadrature
  };
  enum class Law {
    Auto,         ///< hard, with zones linear, or the hyperbola, as the scene suggests
    Hyperbola,    ///< R (R/alpha + h) = eta (Delta - h), eq. (15) of the paper
    Barrier,      ///< the same with 1/alpha = 0: R = eta (Delta - h)/h
    Power,        ///< (R + eta) ((h + R/alpha)/Delta)^m = eta
    Exponential,  ///< R = R_0 (exp(-h/l) - exp(-Delta/l))
    Penalty,      ///< alpha max(-h, 0), its corner smoothed over l
    Hard,         ///< h >= 0, R >= 0, h R = 0: the active set changes at events; at nodes, or over faces
    Linear,       ///< alpha max(-h, 0), with zones
    Overclosure   ///< alpha max(-h, 0)^m, with zones
  };
  /// What part of R, eta and alpha a node has.
  enum class Shares {
    Equal,               ///< 1 each
    DistributionFactors  ///< those of the node set
  };
  /// Which points have the law.
  enum class Carried {
    Near,  ///< those that come near the tool, found along the path
    All
  };
  /// What path following sees of a point of law (15).
  enum class Unknown {
    Displacement,  ///< its displacement: R is found at the point
    Curve          ///< also the place on its curve: hyperbola and barrier, not with tools of type patches
  };
  std::string name;
  std::string tool;
  std::string set;  ///< side set; with nodes: node set, else side set
  Points points = Points::Auto;
  Shares shares = Shares::Equal;       ///< with nodes; not with the hard law
  ShellPlace at = ShellPlace::Middle;  ///< of shells
  int quadratureDegree = 4;            ///< polynomial degree integrated exactly; unused with nodes
  Law law = Law::Auto;
  bool rigid = false;                    ///< 1/alpha = 0: hyperbola and power
  std::optional<double> stiffness;       ///< alpha > 0; empty = chosen, unless rigid
  std::optional<double> regularisation;  ///< eta > 0; empty = chosen
  double exponent = 2;                   ///< m of the laws power and power_overclosure
  std::optional<double> touching;        ///< R_0 > 0 of the exponential law; empty = chosen
  std::optional<double> length;          ///< l > 0 of the exponential and penalty laws; empty = chosen
  std::optional<double> referenceGap;    ///< Delta > eta/alpha; empty = each point's own initial gap
  Carried carried = Carried::All;
  Unknown unknown = Unknown::Displacement;
  /// Whether 1/alpha = 0.
  bool isRigid() const { return rigid || law == Law::Barrier; }
  /// Whether the pressure begins at an edge, up to which zones are integrated.
  bool hasEdge() const { return law == Law::Linear || law == Law::Overclosure; }
};

// ----------------------------------------------------------------------------------------------- path

/// A path, or a branch, ends at whichever comes first; a deck gives at least one.
struct Stop {
  std::vector<double> loadFactors;
  int steps = 1000;
  std::optional<double> pathLength;
  std::optional<int> limitPoint, bifurcation;           ///< number of the one that ends the path, from 1
  std::map<std::string, std::vector<double>> monitors;  ///< name -> values
};

/// A part of a path that begins where the one before has ended.
struct Stage {
  std::string name;
  std::vector<std::string> drives;  ///< entries that follow its load factor; empty: all
  std::vector<std::string>
      release;  ///< supports that it takes away, from load factor 0 to 1; it drives nothing then
  std::optional<int> direction;  ///< sign of the load factor's first change; empty: towards the stop
  Stop stop;
};

struct Path {
  /// How the path is followed.
  enum class Method {
    Series,         ///< one Taylor series a step
    Newton,         ///< arc-length steps by Newton's method, the tangent factored at every iteration
    ModifiedNewton  ///< the same, factored once a step
  };
  /// Which bifurcation points are looked for.
  enum class Critical {
    Off,
    Automatic,  ///< those that the number of negative eigenvalues tells of
    EveryStep   ///< all
  };
  Method method = Method::Series;
  int order = 20;          ///< K, 1..60
  bool autoOrder = false;  ///< K is chosen while running; `order` is that of the first step
  double accuracy = 1e-6;  ///< delta of eq. (36)
  /// Newton steps: largest distance of the path from the cubic between their ends; empty: only the ends are
  /// wanted.
  std::optional<double> cubicAccuracy;
  double residual = 1e-6;                   ///< bound of the relative residual
  double jump = path::Options{}.jumpBound;  ///< the same where points go on to another patch
  int direction = 1;                        ///< sign of the load factor's first change
  std::optional<double> weight;             ///< w of the path parameter, > 0; empty = by the first step
  path::PadeUse pade = path::Options{}.pade;
  Critical criticalPoints = Critical::Automatic;
  bool hopf = false;        ///< Hopf points are looked for
  int hopfEigenvalues = 8;  ///< next to zero, that are computed for them at each step's end
  path::Follow branches = path::Follow::none;
  int branchDepth = 4;   ///< bifurcations between the first path and a branch
  int branchCount = 20;  ///< half-branches followed besides the first path
  /// Sizes of imperfections in the shape of the first bifurcation point's null vector, each of which adds a
  /// path.
  std::vector<double> imperfections;
  /// Load: a small constant force, whose linear response at the start has that size as its largest
  /// displacement; Geometry: the nodes of the undeformed mesh are moved, the farthest by it.
  enum class Imperfection { Load, Geometry };
  Imperfection imperfectionsAs = Imperfection::Load;
  bool restart = true;  ///< keeps what a restart needs at every step
  /// In (0, 1): at the path's end eta of all contacts falls by this factor; empty: does not.
  std::optional<double> sharpen;
  Stop stop;                  ///< of a path without stages
  std::vector<Stage> stages;  ///< one after another
  bool series() const { return method == Method::Series; }
};

struct Solver {
  enum class Type { Mumps, Amesos2, Belos, Auto };
  enum class Preconditioner { SingleFactor, Ilu };
  Type type = Type::Mumps;
  std::string name;  ///< Amesos2's own name of a solver, e.g. klu2; empty with others
  Preconditioner preconditioner = Preconditioner::SingleFactor;  ///< with Belos
  std::optional<double> lowRank;  ///< in (0, 1): what a single-precision factor drops; empty: nothing
  std::optional<double> memory;   ///< GB that Auto may take; empty: what the machine has free
  /// Whether it iterates, or may where a factor is too large.
  bool mayIterate() const { return type == Type::Belos || type == Type::Auto; }
  /// As linear::makeTangentSolver takes it: "mumps", "belos", "auto" or "amesos2:<name>".
  std::string spec() const {
    return type == Type::Amesos2 ? "amesos2:" + name
           : type == Type::Belos ? "belos"
           : type == Type::Auto  ? "auto"
                                 : "mumps";
  }
};

// --------------------------------------------------------------------------------------------- output

enum class OutputField {
  Displacement,
  Field,        ///< all scalar fields
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
  std::optional<Vector3> near;   ///< only the node of the set that is nearest to it before deformation
};

/// A scalar field over the nodes of a set.
struct FieldMonitor {
  std::string field;
  std::string set;  ///< node set, else side set
  DisplacementMonitor::Reduce reduce = DisplacementMonitor::Reduce::Mean;
  std::optional<Vector3> near;  ///< only the node of the set that is nearest to it before deformation
};

/// Total contact force on the tool's side of a contact: the sum of the normal forces, or a component of the
/// resultant that acts on the body. With `near` the normal force (of faces: the pressure times the cubature
/// weight) of the one point that is nearest to a place in the reference configuration; with `along` besides,
/// of all points on the line through that point.
struct ContactForceMonitor {
  std::string contact;
  Component component = Component::Normal;
  std::optional<Vector3> near;
  std::optional<Vector3> along;  ///< direction, not zero, any length
};

/// Area of the undeformed body that is in contact.
struct ContactAreaMonitor {
  std::string contact;
};

/// Pressure of a contact: its largest, or with `near` that at the one point that is nearest to a place in the
/// reference configuration.
struct ContactPressureMonitor {
  std::string contact;
  std::optional<Vector3> near;
};

/// Where a contact's normal forces have their centre, in the deformed body.
struct ContactCenterMonitor {
  std::string contact;
  Component component = Component::X;
};

/// Root-mean-square distance of a contact's normal forces from their centre in the deformed body, or that
/// along one axis.
struct ContactSpreadMonitor {
  std::string contact;
  std::optional<Component> component;
  std::optional<Vector3> about;  ///< in place of the centre
};

/// Total force with which a support holds the body; of a scalar field what flows in there.
struct ReactionMonitor {
  std::string support;
  std::optional<Component> component;  ///< of a support of displacements alone
};

/// The angle of a rigid coupling with an axis, in degrees.
struct RotationMonitor {
  std::string coupling;
};

/// The moment that drives the angle of a rigid coupling.
struct MomentMonitor {
  std::string coupling;
};

struct Monitor {
  std::string name;
  std::variant<DisplacementMonitor, ContactForceMonitor, ContactAreaMonitor, ContactPressureMonitor,
               ContactCenterMonitor, ContactSpreadMonitor, ReactionMonitor, FieldMonitor, RotationMonitor,
               MomentMonitor>
      quantity;
};

struct Output {
  /// What the result file has of shells: their middle surfaces, or solids with their thickness.
  enum class Shells { Surface, Body };
  /// Where the residual of the path is evaluated: at the ends of steps, or at all points.
  enum class Residuals { Steps, Points };
  int pointsPerStep = 5;  ///< rows of path.csv per step, its end included
  Residuals residuals = Residuals::Steps;
  std::vector<OutputField> fields;  ///< never empty after readDeck
  int fieldsEvery = 1;              ///< steps from one state in the result file to the next
  Shells shells = Shells::Surface;
  bool parts = false;  ///< each of several ranks writes its part of the results
  std::vector<Monitor> monitors;
};

// ----------------------------------------------------------------------------------------------- deck

/// A small problem of the models library (atrapos/models/Models.hpp) instead of a mesh.
struct ModelProblem {
  std::string name;
  std::map<std::string, double> parameters;  ///< those that are not its defaults
};

struct Deck {
  std::string file;  ///< as named by the caller; begins every message
  std::string text;  ///< the whole file, for the result file's info records
  std::string title;
  std::optional<ModelProblem> problem;  ///< then of what follows only path, solver, output/points_per_step
  std::vector<std::string> plugins;     ///< names of those that it needs
  MeshInput mesh;
  std::map<std::string, double> constants;  ///< of formulas, by name
  std::vector<Material> materials;          ///< all entries in the deck's order
  std::vector<Physics> physics;
  std::vector<ScalarField> fields;  ///< those of which the deck says where they begin
  std::optional<Plane> plane;
  Shells shells;
  std::vector<ThinSection> membranes, bars;
  std::vector<Support> supports;
  std::vector<Coupling> couplings;
  std::vector<Load> loads;
  std::vector<Tool> tools;
  std::vector<Contact> contacts;
  Path path;
  Solver solver;
  Output output;
};

/// The names of all scalar fields, in the order in which the deck's physics and materials name them.
std::vector<std::string> scalarFields(const Deck& deck);

/// Of all materials at rest; a pressure in the deck's units.
double largestYoungsModulus(const Deck& deck);

/// Reads and validates a whole deck. Throws DeckError for the first thing that is wrong.
Deck readDeck(const std::string& file);

/// The same for a deck in memory; `file` names it in messages and gives the folder of relative file names.
Deck readDeckText(const std::string& text, const std::string& file);

/// Checks every block and set name against the mesh, that each block of the mesh has exactly one material,
/// and that what is meant for shells has shells. Throws DeckError, naming what the mesh has.
void checkAgainstMesh(const Deck& deck, const fem::Mesh& mesh);

/// Whether a contact acts at nodes: it says so, or its set is one of nodes and it says nothing of a law.
bool isAtNodes(const Contact& contact, const fem::Mesh& mesh);

/// Throws DeckError about the value at `keys`, "supports/clamp/set", with its place in the deck.
[[noreturn]] void failAt(const Deck& deck, const std::string& keys, const std::string& what);

/// Prints the effective values, defaults included, as a deck that reads back to the same values.
void describe(const Deck& deck, std::ostream& out);

/// Prints every key with what it accepts, its default and its meaning, one line each.
void describeKeys(std::ostream& out);

}  // namespace atrapos::deck
