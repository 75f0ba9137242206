#include "atrapos/cad/ReadFaces.hpp"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace atrapos::cad {
namespace {

/// OpenCASCADE writes what it does to standard output; libraries here print nothing.
class Silence {
 public:
  Silence() { Message::DefaultMessenger()->ChangePrinters().Clear(); }
  ~Silence() { Message::DefaultMessenger()->ChangePrinters() = printers_; }
  Silence(const Silence&) = delete;

 private:
  Message_SequenceOfPrinters printers_ = Message::DefaultMessenger()->Printers();
};

std::string ending(const std::string& file) {
  std::string text = std::filesystem::path(file).extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

template <class Reader>
TopoDS_Shape shape(const std::string& file, const char* format) {
  Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) {
    throw Error(file + ": is not a " + format + " file, or is cut short");
  }
  reader.TransferRoots();
  return reader.OneShape();
}

std::string kindOf(const Handle(Geom_Surface) & surface) {
  switch (GeomAdaptor_Surface(surface).GetType()) {
    case GeomAbs_Plane:
      return "plane";
    case GeomAbs_Cylinder:
      return "cylinder";
    case GeomAbs_Cone:
      return "cone";
    case GeomAbs_Sphere:
      return "sphere";
    case GeomAbs_Torus:
      return "torus";
    case GeomAbs_BezierSurface:
    case GeomAbs_BSplineSurface:
      return "spline";
    case GeomAbs_SurfaceOfRevolution:
      return "revolved";
    case GeomAbs_SurfaceOfExtrusion:
      return "swept";
    case GeomAbs_OffsetSurface:
      return "offset";
    default:
      return "other";
  }
}

/// The rectangle of parameters around a face.
struct Bounds {
  double u1, u2, v1, v2;
  explicit Bounds(const TopoDS_Face& face) { BRepTools::UVBounds(face, u1, u2, v1, v2); }

  /// Whether every edge of the face runs along one of the four sides. Edges without a length (poles) lie on
  /// one by construction.
  bool areEdgesOf(const TopoDS_Face& face) const {
    // A file's curves are good to its tolerance, 1e-7 mm as a rule, in lengths of 1 mm and more.
    const double tolerance = 1e-6;
    const auto at = [&](double x, double side, double range) {
      return std::fabs(x - side) <= tolerance * range;
    };
    for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
      double first = 0, last = 0;
      const Handle(Geom2d_Curve) curve =
          BRep_Tool::CurveOnSurface(TopoDS::Edge(edges.Current()), face, first, last);
      if (curve.IsNull()) return false;
      bool sides[4] = {true, true, true, true};
      for (int i = 0; i <= 4; ++i) {
        const gp_Pnt2d p = curve->Value(first + (last - first) * i / 4);
        sides[0] = sides[0] && at(p.X(), u1, u2 - u1);
        sides[1] = sides[1] && at(p.X(), u2, u2 - u1);
        sides[2] = sides[2] && at(p.Y(), v1, v2 - v1);
        sides[3] = sides[3] && at(p.Y(), v2, v2 - v1);
      }
      if (std::none_of(sides, sides + 4, [](bool on) { return on; })) return false;
    }
    return true;
  }
};

/// Knots with their multiplicities.
template <class Values, class Multiplicities>
std::vector<double> knots(const Values& values, const Multiplicities& multiplicities) {
  std::vector<double> all;
  for (int i = values.Lower(); i <= values.Upper(); ++i)
    all.insert(all.end(), static_cast<std::size_t>(multiplicities(i)), values(i));
  return all;
}

contact::NurbsSurface nurbs(const Geom_BSplineSurface& s, double scale) {
  contact::NurbsSurface surface;
  surface.degree = {s.UDegree(), s.VDegree()};
  surface.count = {s.NbUPoles(), s.NbVPoles()};
  surface.knots = {knots(s.UKnots(), s.UMultiplicities()), knots(s.VKnots(), s.VMultiplicities())};
  const bool rational = s.IsURational() || s.IsVRational();
  for (int i = 1; i <= s.NbUPoles(); ++i)
    for (int j = 1; j <= s.NbVPoles(); ++j) {
      const gp_Pnt p = s.Pole(i, j);
      surface.points.push_back({scale * p.X(), scale * p.Y(), scale * p.Z()});
      if (rational) surface.weights.push_back(s.Weight(i, j));
    }
  return surface;
}

Face face(const TopoDS_Face& shape, int number, double scale) {
  const Handle(Geom_Surface) geometry =
      BRep_Tool::Surface(shape);  // where the body is, not where it was drawn
  const Bounds bounds(shape);
  Face result;
  result.number = number;
  result.kind = kindOf(geometry);
  result.trimmed = !bounds.areEdgesOf(shape);
  const Handle(Geom_BSplineSurface) spline = GeomConvert::SurfaceToBSplineSurface(
      new Geom_RectangularTrimmedSurface(geometry, bounds.u1, bounds.u2, bounds.v1, bounds.v2));
  if (spline->IsUPeriodic()) spline->SetUNotPeriodic();
  if (spline->IsVPeriodic()) spline->SetVNotPeriodic();
  if (shape.Orientation() == TopAbs_REVERSED) spline->UReverse();
  result.surface = nurbs(*spline, scale);
  result.box = {result.surface.points.front(), result.surface.points.front()};
  for (const auto& point : result.surface.points)
    for (std::size_t c = 0; c < 3; ++c) {
      result.box[0][c] = std::min(result.box[0][c], point[c]);
      result.box[1][c] = std::max(result.box[1][c], point[c]);
    }
  return result;
}

}  // namespace

std::vector<Face> readFaces(const std::string& file, double scale) {
  if (!(scale > 0) || !std::isfinite(scale))
    throw std::invalid_argument("readFaces: scale must be a number > 0");
  const std::string end = ending(file);
  const bool step = end == ".step" || end == ".stp", iges = end == ".iges" || end == ".igs";
  if (!step && !iges)
    throw std::invalid_argument(file + ": ends neither in .step or .stp (STEP) nor in .iges or .igs (IGES)");
  if (!std::filesystem::is_regular_file(file)) throw Error(file + ": no such file");

  const Silence silence;
  std::vector<Face> faces;
  try {
    const TopoDS_Shape all =
        step ? shape<STEPControl_Reader>(file, "STEP") : shape<IGESControl_Reader>(file, "IGES");
    for (TopExp_Explorer each(all, TopAbs_FACE); !all.IsNull() && each.More(); each.Next())
      faces.push_back(face(TopoDS::Face(each.Current()), static_cast<int>(faces.size()) + 1, scale));
  } catch (const Standard_Failure& failure) {
    throw Error(file + ": face " + std::to_string(faces.size() + 1) + " makes no spline surface (" +
                failure.GetMessageString() + ")");
  }
  if (faces.empty()) throw Error(file + ": has no face");
  return faces;
}

}  // namespace atrapos::cad
