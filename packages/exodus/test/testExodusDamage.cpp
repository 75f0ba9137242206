// Files that were cut, scrambled or never were Exodus: always one Error, never a crash or a half mesh, and
// nothing on standard error.
#include <exodusII.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "SampleMesh.hpp"
#include "TempFile.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/exodus/ResultWriter.hpp"

using namespace atrapos;

namespace {

std::string contentOf(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void put(const std::string& file, const std::string& content) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
}

void expectError(const std::string& file) {
  EXPECT_THROW(exodus::readMesh(file), exodus::Error);
  EXPECT_THROW(exodus::ResultReader reader(file), exodus::Error);
}

std::string sampleContent(bool steps) {
  const TempFile file;
  const auto mesh = sampleMesh(fem::Topology::Hex8);
  if (!steps) {
    exodus::writeMesh(mesh, file());
    return contentOf(file());
  }
  exodus::ResultNames names;
  names.nodal = {"u", "v"};
  names.element = {"s"};
  names.global = {"load_factor"};
  exodus::ResultWriter writer(file(), mesh, names);
  const auto nodes = static_cast<std::size_t>(mesh.numNodes()),
             elements = static_cast<std::size_t>(mesh.numElements());
  for (int step = 1; step <= 3; ++step)
    writer.writeStep(step, std::vector<double>(2 * nodes, 1.5), std::vector<double>(elements, 2.5),
                     std::vector<double>(1, 3.5));
  return contentOf(file());
}

// The sample as NetCDF-4, copied by the library.
std::string hdf5Content() {
  const TempFile file;
  exodus::writeMesh(sampleMesh(fem::Topology::Hex8), file("classic.exo"));
  ex_opts(0);
  int words = 8, fileWords = 0, newWords = 8;
  float version = 0.0F;
  const int from = ex_open(file("classic.exo").c_str(), EX_READ, &words, &fileWords, &version);
  const int to = ex_create(file("hdf5.exo").c_str(), EX_CLOBBER | EX_NETCDF4, &words, &newWords);
  if (from < 0 || to < 0 || ex_copy(from, to) < 0) throw std::runtime_error("no NetCDF-4 file");
  ex_close(from);
  ex_close(to);
  return contentOf(file("hdf5.exo"));
}

class Quiet {
 public:
  Quiet() {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
  }
  ~Quiet() {
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  }
};

}  // namespace

TEST(ExodusDamage, classicFileCutAnywhere) {
  const Quiet quiet;
  const TempFile file;
  for (bool steps : {false, true}) {
    SCOPED_TRACE(steps ? "with steps" : "mesh only");
    const std::string content = sampleContent(steps);
    put(file(), content);
    EXPECT_NO_THROW(exodus::readMesh(file()));
    // Every length would take long; 37 is prime, so all places within numbers are met.
    for (std::size_t length = 0; length < content.size(); length += 37) {
      SCOPED_TRACE(length);
      put(file(), content.substr(0, length));
      expectError(file());
    }
    // The last bytes can be padding after a string; one number less is data.
    for (std::size_t missing : {4, 5, 8, 9, 64}) {
      SCOPED_TRACE(missing);
      put(file(), content.substr(0, content.size() - missing));
      expectError(file());
    }
  }
}

TEST(ExodusDamage, hdf5FileCutAnywhere) {
  const Quiet quiet;
  const TempFile file;
  const std::string content = hdf5Content();
  put(file(), content);
  ASSERT_EQ(exodus::readMesh(file()).numElements(), 6);
  for (std::size_t length = 0; length < content.size(); length += 997) {
    SCOPED_TRACE(length);
    put(file(), content.substr(0, length));
    expectError(file());
  }
  put(file(), content.substr(0, content.size() - 1));
  expectError(file());
}

TEST(ExodusDamage, neverExodus) {
  const Quiet quiet;
  const TempFile file;
  std::mt19937 random(1);
  for (const std::string start : {"", "CDF\x01", "CDF\x02", "CDF\x05", "\x89HDF\r\n\x1a\n", "CDF", "CDF\x03"})
    for (int trial = 0; trial < 20; ++trial) {
      std::string content = start;
      const int length = trial * trial * 50;
      for (int i = 0; i < length; ++i) content += static_cast<char>(random());
      put(file(), content);
      expectError(file());
    }
  put(file(), "# a deck\nsolver: {}\n");
  expectError(file());

  // A NetCDF file of someone else: no dimensions, attributes or variables.
  put(file(), std::string("CDF\x01", 4) + std::string(28, '\0'));
  expectError(file());
}

// Bytes of the header changed at random: the file may still be readable (a letter of a name), but then the
// mesh has what it must have; else Error.
TEST(ExodusDamage, scrambledHeadersNeverCrash) {
  const Quiet quiet;
  const TempFile file;
  const std::string content = sampleContent(true);
  std::mt19937 random(2);
  int errors = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    SCOPED_TRACE(trial);
    std::string changed = content;
    const std::size_t at = random() % 8000;
    changed[at % changed.size()] = static_cast<char>(random());
    put(file(), changed);
    try {
      const auto mesh = exodus::readMesh(file());
      EXPECT_GT(mesh.numElements(), 0);
      const exodus::ResultReader reader(file());
      for (int step = 0; step < reader.numSteps(); ++step)
        for (const auto& name : reader.nodalNames()) reader.nodal(step, name);
    } catch (const exodus::Error&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, 100);  // most of the header is structure
}
