// Faces of STEP and IGES files that OpenCASCADE writes here: against the geometry that was written.
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Writer.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "atrapos/cad/ReadFaces.hpp"
#include "atrapos/contact/PatchPoint.hpp"

namespace atrapos::cad {
namespace {

using Vector3 = std::array<double, 3>;

// STEP files hold 15 digits of coordinates up to 100; spline conversion adds a few roundings.
constexpr double kRounding = 1e-11;
// IGES files hold 9 digits behind the point.
constexpr double kIgesRounding = 1e-9;

std::string path(const std::string& name) {
  return (std::filesystem::path(testing::TempDir()) / ("atrapos_faces_" + name)).string();
}

std::string step(const TopoDS_Shape& shape, const std::string& name) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  STEPControl_Writer writer;
  writer.Transfer(shape, STEPControl_AsIs);
  EXPECT_EQ(writer.Write(path(name).c_str()), IFSelect_RetDone);
  return path(name);
}

std::string iges(const TopoDS_Shape& shape, const std::string& name) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer;
  writer.AddShape(shape);
  writer.ComputeModel();
  EXPECT_TRUE(writer.Write(path(name).c_str()));
  return path(name);
}

TopoDS_Shape cylinder() { return BRepPrimAPI_MakeCylinder(gp_Ax2({3, -7, 2}, {0, 1, 0}), 50, 20).Shape(); }

const Face& only(const std::vector<Face>& faces, const std::string& kind) {
  const auto found = std::find_if(faces.begin(), faces.end(), [&](const Face& f) { return f.kind == kind; });
  EXPECT_NE(found, faces.end()) << kind;
  return *found;
}

/// At places all over the surface: the point, S_1 x S_2 not normalised.
void everywhere(const Face& face, const std::function<void(const Vector3&, const Vector3&)>& check) {
  for (const contact::BezierPatch& patch : face.surface.patches()) {
    const auto coefficients = patch.coefficients(patch.degree);
    for (const double t1 : {-0.9, -0.3, 0.2, 0.7})
      for (const double t2 : {-0.8, 0.1, 0.95}) {
        const auto s = contact::PatchPoint::of(coefficients.data(), patch.degree[0], patch.degree[1], t1, t2);
        double n[3];
        s.cross(n);
        check({s.S[0], s.S[1], s.S[2]}, {n[0], n[1], n[2]});
      }
  }
}

void expectCylinder(const Face& face, double scale) {
  const double rounding = kRounding * scale;
  EXPECT_FALSE(face.trimmed);
  EXPECT_NEAR(face.box[0][1], -7 * scale, rounding);
  EXPECT_NEAR(face.box[1][1], 13 * scale, rounding);
  everywhere(face, [&](const Vector3& x, const Vector3& n) {
    const double a = x[0] - 3 * scale, b = x[2] - 2 * scale, r = std::hypot(a, b);
    EXPECT_NEAR(r, 50 * scale, rounding);
    EXPECT_NEAR((n[0] * a + n[2] * b) / (r * std::hypot(n[0], n[1], n[2])), 1, kRounding);  // outwards
  });
}

TEST(ReadFaces, CylinderIsExact) {
  for (const std::string& file : {step(cylinder(), "roll.step"), iges(cylinder(), "roll.igs")}) {
    const auto faces = readFaces(file);
    EXPECT_EQ(faces.size(), 3u) << file;  // the discs at its ends are trimmed planes
    EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const Face& f) { return f.trimmed; }), 2);
    for (std::size_t n = 0; n < faces.size(); ++n) EXPECT_EQ(faces[n].number, static_cast<int>(n) + 1);
  }
  expectCylinder(only(readFaces(path("roll.step")), "cylinder"), 1);
}

TEST(ReadFaces, UnitsAndScale) {
  std::ostringstream text;
  text << std::ifstream(step(cylinder(), "millimetres.step")).rdbuf();
  std::string metres = text.str();
  const std::string unit = ".MILLI.,.METRE.";
  ASSERT_NE(metres.find(unit), std::string::npos);
  metres.replace(metres.find(unit), unit.size(), "$,.METRE.");
  std::ofstream(path("metres.step")) << metres;
  expectCylinder(only(readFaces(path("metres.step")), "cylinder"), 1000);
  expectCylinder(only(readFaces(path("metres.step"), 0.001), "cylinder"), 1);
}

TEST(ReadFaces, TorusPointsOutwards) {
  const TopoDS_Shape torus = BRepPrimAPI_MakeTorus(gp_Ax2({0, 0, 0}, {0, 0, 1}), 30, 4).Shape();
  const auto faces = readFaces(step(torus, "torus.step"));
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_FALSE(faces[0].trimmed);
  everywhere(faces[0], [](const Vector3& x, const Vector3& n) {
    const double R = std::hypot(x[0], x[1]);
    const Vector3 out = {x[0] * (1 - 30 / R), x[1] * (1 - 30 / R), x[2]};
    EXPECT_NEAR(std::hypot(out[0], out[1], out[2]), 4, kRounding);
    EXPECT_GT(out[0] * n[0] + out[1] * n[1] + out[2] * n[2], 0);
  });
}

/// A rational surface of degrees 3 and 2 with an inner knot.
Handle(Geom_BSplineSurface) wavy() {
  TColgp_Array2OfPnt points(1, 5, 1, 3);
  TColStd_Array2OfReal weights(1, 5, 1, 3);
  for (int i = 1; i <= 5; ++i)
    for (int j = 1; j <= 3; ++j) {
      points(i, j) = gp_Pnt(10 * i, 8 * j, std::sin(2.0 * i + j));
      weights(i, j) = 1 + 0.1 * i * j;
    }
  TColStd_Array1OfReal u(1, 3), v(1, 2);
  TColStd_Array1OfInteger multiU(1, 3), multiV(1, 2);
  u(1) = 0, u(2) = 0.4, u(3) = 1, v(1) = 0, v(2) = 1;
  multiU(1) = 4, multiU(2) = 1, multiU(3) = 4, multiV(1) = 3, multiV(2) = 3;
  return new Geom_BSplineSurface(points, weights, u, v, multiU, multiV, 3, 2);
}

TEST(ReadFaces, SplinesKeepPointsKnotsAndWeights) {
  const TopoDS_Shape shape = BRepBuilderAPI_MakeFace(wavy(), 1e-7).Shape();
  for (const bool exact : {true, false}) {
    const std::string file = exact ? step(shape, "wavy.step") : iges(shape, "wavy.iges");
    const double rounding = exact ? kRounding : kIgesRounding;
    const auto faces = readFaces(file);
    ASSERT_EQ(faces.size(), 1u) << file;
    const contact::NurbsSurface& s = faces[0].surface;
    EXPECT_EQ(faces[0].kind, "spline");
    EXPECT_FALSE(faces[0].trimmed);
    EXPECT_EQ(s.degree, (std::array<int, 2>{3, 2}));
    EXPECT_EQ(s.knots[0], (std::vector<double>{0, 0, 0, 0, 0.4, 1, 1, 1, 1}));
    EXPECT_EQ(s.knots[1], (std::vector<double>{0, 0, 0, 1, 1, 1}));
    ASSERT_EQ(s.points.size(), 15u);
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 3; ++j) {
        const gp_Pnt p = wavy()->Pole(i + 1, j + 1);
        const Vector3 wanted = {p.X(), p.Y(), p.Z()};
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(s.points[static_cast<std::size_t>(3 * i + j)][c], wanted[c], rounding) << file;
        EXPECT_NEAR(s.weights[static_cast<std::size_t>(3 * i + j)], wavy()->Weight(i + 1, j + 1), rounding);
      }
  }
}

void expectRefused(const std::string& file, const std::string& text) {
  try {
    readFaces(file);
    ADD_FAILURE() << file << " was read";
  } catch (const std::exception& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find(file), std::string::npos) << line;
    EXPECT_NE(line.find(text), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST(ReadFaces, RefusesWhatIsNone) {
  expectRefused(path("missing.step"), "no such file");
  expectRefused(path("roll.obj"), "IGES");
  std::ofstream(path("text.step")) << "not a STEP file\n";
  expectRefused(path("text.step"), "is not a STEP file");
  std::ofstream(path("text.igs")) << "not an IGES file\n";
  expectRefused(path("text.igs"), "has no face");
  EXPECT_THROW(readFaces(path("roll.step"), -1), std::invalid_argument);
}

TEST(ReadFaces, PrintsNothing) {
  const std::string file = step(cylinder(), "quiet.step");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  readFaces(file);
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace atrapos::cad
