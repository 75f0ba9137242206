// Results step by step: what is written is read, and what was written before a kill stays.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "SampleMesh.hpp"
#include "TempFile.hpp"
#include "atrapos/exodus/InfoRecords.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/exodus/ResultWriter.hpp"
#include "atrapos/fem/StructuredShell.hpp"

using namespace atrapos;

namespace {

exodus::ResultNames sampleNames() {
  exodus::ResultNames names;
  names.nodal = {"displ_x", "displ_y", "displ_z"};
  names.element = {"stress_xx", "an element variable whose name is well over thirty-two characters"};
  names.global = {"load_factor", "series_radius"};
  return names;
}

// Values that differ by step, variable and place.
std::vector<double> values(int step, int kind, std::size_t count) {
  std::vector<double> result(count);
  for (std::size_t i = 0; i < count; ++i)
    result[i] = std::sin(1.0 + step + 10.0 * kind) + 0.001 * static_cast<double>(i);
  return result;
}

double timeOf(int step) { return 0.1 * (step + 1); }

void writeSampleStep(exodus::ResultWriter& writer, const fem::Mesh& mesh, int step) {
  const auto nodes = static_cast<std::size_t>(mesh.numNodes());
  const auto elements = static_cast<std::size_t>(mesh.numElements());
  writer.writeStep(timeOf(step), values(step, 0, 3 * nodes), values(step, 1, 2 * elements),
                   values(step, 2, 2));
}

void expectSampleStep(const exodus::ResultReader& reader, const fem::Mesh& mesh, int step) {
  const auto nodes = static_cast<std::size_t>(mesh.numNodes());
  const auto elements = static_cast<std::size_t>(mesh.numElements());
  const auto names = sampleNames();
  const auto part = [](const std::vector<double>& all, std::size_t which, std::size_t count) {
    const auto first = all.begin() + static_cast<long>(which * count);
    return std::vector<double>(first, first + static_cast<long>(count));
  };
  for (std::size_t v = 0; v < 3; ++v)
    EXPECT_EQ(reader.nodal(step, names.nodal[v]), part(values(step, 0, 3 * nodes), v, nodes));
  for (std::size_t v = 0; v < 2; ++v)
    EXPECT_EQ(reader.element(step, names.element[v]), part(values(step, 1, 2 * elements), v, elements));
  EXPECT_EQ(reader.globals(step), values(step, 2, 2));
  EXPECT_EQ(reader.global(step, "series_radius"), values(step, 2, 2)[1]);
  EXPECT_EQ(reader.times()[static_cast<std::size_t>(step)], timeOf(step));
}

}  // namespace

TEST(ExodusResults, roundTrip) {
  const TempFile file;
  const auto mesh = sampleMesh(fem::Topology::Hex20);
  auto names = sampleNames();
  names.qa = {{"mesher", "1.2", "2020/01/31", "12:00:00"}};
  names.info = {"first: line", "", std::string(200, 'x') + " end", "two\nlines"};
  {
    exodus::ResultWriter writer(file(), mesh, names);
    for (int step = 0; step < 5; ++step) writeSampleStep(writer, mesh, step);
    EXPECT_EQ(writer.numSteps(), 5);
  }
  const exodus::ResultReader reader(file());
  EXPECT_EQ(reader.numSteps(), 5);
  EXPECT_EQ(reader.nodalNames(), names.nodal);
  EXPECT_EQ(reader.elementNames(), names.element);
  EXPECT_EQ(reader.globalNames(), names.global);
  for (int step = 0; step < 5; ++step) expectSampleStep(reader, mesh, step);

  EXPECT_EQ(reader.info(),
            (std::vector<std::string>{"first: line", "", std::string(200, 'x') + " end", "two", "lines"}));
  const auto qa = reader.qa();
  ASSERT_EQ(qa.size(), 2u);
  EXPECT_EQ(qa[0].code, "mesher");
  EXPECT_EQ(qa[1].code, "Atrapos");
  EXPECT_EQ(qa[1].date.size(), 10u);
  EXPECT_EQ(qa[1].time.size(), 8u);

  const auto back = exodus::readMesh(file());
  EXPECT_EQ(back.nodeIds, mesh.nodeIds);
  EXPECT_EQ(back.elementIds, mesh.elementIds);
  EXPECT_EQ(back.blocks[0].name, mesh.blocks[0].name);
  EXPECT_EQ(back.blocks[1].attributes, mesh.blocks[1].attributes);
}

TEST(ExodusResults, everyStepCanBeReadAsSoonAsItIsWritten) {
  const TempFile file;
  const auto mesh = sampleMesh(fem::Topology::Tet4);
  exodus::ResultWriter writer(file(), mesh, sampleNames());
  EXPECT_EQ(exodus::ResultReader(file()).numSteps(), 0);
  EXPECT_TRUE(exodus::ResultReader(file()).times().empty());
  for (int step = 0; step < 4; ++step) {
    writeSampleStep(writer, mesh, step);
    const exodus::ResultReader reader(file());
    ASSERT_EQ(reader.numSteps(), step + 1);
    for (int s = 0; s <= step; ++s) expectSampleStep(reader, mesh, s);
  }
}

TEST(ExodusResults, kindsWithoutVariablesAreAllowed) {
  const TempFile file;
  const auto mesh = fem::boxMesh({});
  for (int only = 0; only < 4; ++only) {
    exodus::ResultNames names;
    if (only == 0) names.nodal = {"a"};
    if (only == 1) names.element = {"a"};
    if (only == 2) names.global = {"a"};
    exodus::ResultWriter writer(file(), mesh, names);
    writer.writeStep(1.0, std::vector<double>(8 * names.nodal.size(), 2.0),
                     std::vector<double>(names.element.size(), 3.0),
                     std::vector<double>(names.global.size(), 4.0));
    const exodus::ResultReader reader(file());
    EXPECT_EQ(reader.numSteps(), 1);
    if (only == 0) {
      EXPECT_EQ(reader.nodal(0, "a"), std::vector<double>(8, 2.0));
    }
    if (only == 1) {
      EXPECT_EQ(reader.element(0, "a"), std::vector<double>(1, 3.0));
    }
    if (only == 2) {
      EXPECT_EQ(reader.global(0, "a"), 4.0);
    }
  }
}

TEST(ExodusResults, emptyBlocksHoldNothing) {
  const TempFile file;
  auto mesh = fem::boxMesh({});
  fem::Block empty;
  empty.name = "empty";
  empty.id = 99;
  mesh.blocks.insert(mesh.blocks.begin(), empty);
  exodus::ResultWriter writer(file(), mesh, sampleNames());
  writeSampleStep(writer, mesh, 0);
  expectSampleStep(exodus::ResultReader(file()), mesh, 0);
}

TEST(ExodusResults, badStepsAndNamesThrowAndLeaveTheFileAsItWas) {
  const TempFile file;
  const auto mesh = fem::boxMesh({});
  auto names = sampleNames();
  names.nodal[1] = names.nodal[0];
  EXPECT_THROW(exodus::ResultWriter(file(), mesh, names), exodus::Error);
  names.nodal[1] = "";
  EXPECT_THROW(exodus::ResultWriter(file(), mesh, names), exodus::Error);
  names = sampleNames();
  names.qa = {{"a program whose name is over 32 characters", "1", "", ""}};
  EXPECT_THROW(exodus::ResultWriter(file(), mesh, names), exodus::Error);
  EXPECT_FALSE(std::filesystem::exists(file()));

  exodus::ResultWriter writer(file(), mesh, sampleNames());
  const std::vector<double> nodal(24), element(2), global(2);
  writer.writeStep(1.0, nodal, element, global);
  EXPECT_THROW(writer.writeStep(1.0, nodal, element, global), exodus::Error);
  EXPECT_THROW(writer.writeStep(0.5, nodal, element, global), exodus::Error);
  EXPECT_THROW(writer.writeStep(std::nan(""), nodal, element, global), exodus::Error);
  EXPECT_THROW(writer.writeStep(2.0, global, element, global), exodus::Error);
  EXPECT_THROW(writer.writeStep(2.0, nodal, nodal, global), exodus::Error);
  EXPECT_THROW(writer.writeStep(2.0, nodal, element, nodal), exodus::Error);
  EXPECT_EQ(exodus::ResultReader(file()).numSteps(), 1);
  writer.writeStep(2.0, nodal, element, global);
  const exodus::ResultReader reader(file());
  EXPECT_EQ(reader.times(), (std::vector<double>{1.0, 2.0}));
  EXPECT_THROW(reader.nodal(2, "displ_x"), exodus::Error);
  EXPECT_THROW(reader.nodal(-1, "displ_x"), exodus::Error);
  EXPECT_THROW(reader.nodal(0, "displ"), exodus::Error);
  EXPECT_THROW(reader.element(0, "displ_x"), exodus::Error);
  EXPECT_THROW(reader.global(0, "displ_x"), exodus::Error);
}

TEST(ExodusResults, resultsOfShellsStandOnTheirMiddleSurface) {
  const TempFile file;
  fem::ShellCylinderOptions options;
  options.divisions = {4, 2};
  options.thickness = 0.01;
  const auto mesh = fem::shellCylinderMesh(options);
  {
    exodus::ResultWriter writer(file(), mesh, sampleNames());
    for (int step = 0; step < 3; ++step) writeSampleStep(writer, mesh, step);
  }
  for (int step = 0; step < 3; ++step) expectSampleStep(exodus::ResultReader(file()), mesh, step);
  const auto back = exodus::readMesh(file());
  EXPECT_EQ(back.blocks[0].topology, fem::Topology::Shell8);
  EXPECT_EQ(back.blocks[0].attributes, mesh.blocks[0].attributes);
}

TEST(ExodusResults, twoFilesAtATime) {
  const TempFile file;
  const auto hexes = sampleMesh(fem::Topology::Hex8), tets = sampleMesh(fem::Topology::Tet10);
  exodus::ResultWriter a(file("a.exo"), hexes, sampleNames()), b(file("b.exo"), tets, sampleNames());
  for (int step = 0; step < 3; ++step) {
    writeSampleStep(a, hexes, step);
    writeSampleStep(b, tets, step);
  }
  exodus::ResultWriter moved = std::move(a);
  writeSampleStep(moved, hexes, 3);
  expectSampleStep(exodus::ResultReader(file("a.exo")), hexes, 3);
  expectSampleStep(exodus::ResultReader(file("b.exo")), tets, 2);
}

// A child writes steps and dies without closing the file.
TEST(ExodusResults, stepsBeforeAnAbruptEndStay) {
  const TempFile file;
  const auto mesh = sampleMesh(fem::Topology::Wedge15);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    exodus::ResultWriter writer(file(), mesh, sampleNames());
    for (int step = 0; step < 7; ++step) writeSampleStep(writer, mesh, step);
    raise(SIGKILL);
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  const exodus::ResultReader reader(file());
  ASSERT_EQ(reader.numSteps(), 7);
  for (int step = 0; step < 7; ++step) expectSampleStep(reader, mesh, step);
}

// The child is killed from outside at moments of no one's choosing, mostly in the middle of a step; it
// reports each finished one through a pipe.
TEST(ExodusResults, finishedStepsSurviveAKillInTheMiddleOfAStep) {
  fem::BoxOptions options;
  options.divisions = {12, 12, 12};  // a step is some hundred KB: most of the time goes into writing it
  options.topology = fem::Topology::Hex20;
  const auto mesh = fem::boxMesh(options);
  int finishedInAll = 0;
  for (int trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE(trial);
    const TempFile file;
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      exodus::ResultWriter writer(file(), mesh, sampleNames());
      for (int step = 0;; ++step) {
        writeSampleStep(writer, mesh, step);
        const char done = 1;
        if (write(ends[1], &done, 1) != 1) _exit(1);
      }
    }
    close(ends[1]);
    char done = 0;
    ASSERT_EQ(read(ends[0], &done, 1), 1);
    std::this_thread::sleep_for(std::chrono::microseconds(4000 + 1700 * trial));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    int finished = 1;
    while (read(ends[0], &done, 1) == 1) ++finished;
    close(ends[0]);
    finishedInAll += finished;

    const exodus::ResultReader reader(file());
    EXPECT_GE(reader.numSteps(), finished);
    EXPECT_LE(reader.numSteps(), finished + 1);  // killed between the last flush and the report
    for (int step = 0; step < reader.numSteps(); ++step) expectSampleStep(reader, mesh, step);
  }
  EXPECT_GT(finishedInAll, 12);  // some ran on after their first step
}

TEST(ExodusResults, infoRecordsFollowTheContinuationRule) {
  using exodus::fromInfoRecords;
  using exodus::toInfoRecords;
  const std::string x79(79, 'x');
  EXPECT_EQ(toInfoRecords({"a", "b\n\nc\n", ""}), (std::vector<std::string>{"a", "b", "", "c", ""}));
  EXPECT_EQ(toInfoRecords({x79 + "y"}), std::vector<std::string>{x79 + "y"});
  EXPECT_EQ(toInfoRecords({x79 + "yz"}), (std::vector<std::string>{x79 + "\\", "yz"}));
  EXPECT_EQ(toInfoRecords({x79 + "\\"}), (std::vector<std::string>{x79 + "\\", "\\"}));
  EXPECT_EQ(toInfoRecords({"short\\"}), std::vector<std::string>{"short\\"});
  for (std::size_t length : {0, 1, 78, 79, 80, 81, 157, 158, 159, 160, 161, 238, 500})
    for (char c : {'a', '\\'}) {
      const std::vector<std::string> lines = {std::string(length, c), "next"};
      for (const auto& record : toInfoRecords(lines)) EXPECT_LE(record.size(), 80u);
      EXPECT_EQ(fromInfoRecords(toInfoRecords(lines)), lines);
    }
}
