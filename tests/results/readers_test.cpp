// Independent readers find the right times, points and fields: h5py, meshio, ParaView.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "results/synthetic.hpp"

namespace gnomon::readers_test {
namespace {

const std::string kScripts = std::string(GNOMON_SOURCE_DIR) + "/tests/results/";

// A result that was not closed, with a space and an ampersand in its name.
std::filesystem::path write(const std::string& name, const Grid& grid) {
  const auto file = synthetic::folder(name) / "worn & torn.h5";
  ResultWriter writer(file, synthetic::header(), grid);
  for (int i = 0; i < 5; ++i) writer.append(synthetic::row(i));
  for (const double t : {0.0, 0.1, 1.0}) {
    writer.store(t, synthetic::fields(grid, t), synthetic::contact(t), synthetic::counter_body(t));
  }
  return file;
}

std::string sidecar(std::filesystem::path file) {
  return file.replace_extension(".xdmf").string();
}

// Runs a command and returns its exit status; its output explains a failure.
testing::AssertionResult succeeds(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string output;
  for (int c = 0; pipe != nullptr && (c = std::fgetc(pipe)) != EOF;) output += static_cast<char>(c);
  const int status = pipe == nullptr ? -1 : pclose(pipe);
  if (status == 0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << command << "\n" << output;
}

// Debian's Python has Debian's h5py and meshio; another one may come first in PATH.
testing::AssertionResult python(const std::string& arguments) {
  return succeeds("/usr/bin/python3 -W error::SyntaxWarning " + kScripts + arguments);
}

std::string quoted(const std::string& text) {
  return " '" + text + "'";
}

TEST(Readers, H5pyReadsEverything) {
  const auto file = write("h5py", synthetic::grid(4, 3));
  EXPECT_TRUE(python("check_with_h5py.py" + quoted(file.string()) + " 0 0.1 1"));
}

TEST(Readers, MeshioReadsTheSidecar) {
  const auto flat = write("meshio2", synthetic::grid(4, 3));
  EXPECT_TRUE(python("check_with_meshio.py" + quoted(sidecar(flat)) + " quad 0 0.1 1"));
  const auto solid = write("meshio3", synthetic::hexahedra());
  EXPECT_TRUE(python("check_with_meshio.py" + quoted(sidecar(solid)) + " hexahedron 0 0.1 1"));
}

// A second collection beside the body, whose data are in the file as the sidecar says.
TEST(Readers, SidecarHasTheCounterBodyBesideTheBody) {
  const auto file = write("counter", synthetic::grid(4, 3));
  EXPECT_TRUE(is_sidecar(sidecar(file)));
  EXPECT_TRUE(python("check_counter_body.py" + quoted(sidecar(file)) + " 0 0.1 1"));
}

TEST(Readers, ParaViewWarpsTheResult) {
  if (!succeeds("command -v pvpython")) GTEST_SKIP() << "pvpython (ParaView) is not installed";
  for (const Grid& grid : {synthetic::grid(4, 3), synthetic::hexahedra()}) {
    const auto file = write("paraview", grid);
    EXPECT_TRUE(succeeds("env -u DISPLAY pvpython --force-offscreen-rendering " + kScripts +
                         "check_with_paraview.py" + quoted(sidecar(file)) + " 0 0.1 1"));
  }
}

TEST(Readers, SidecarIsWholeBeforeTheFirstStoredStep) {
  const auto file = synthetic::folder("empty") / "r.h5";
  ResultWriter writer(file, synthetic::header(), synthetic::grid(4, 3));
  EXPECT_TRUE(
      succeeds("/usr/bin/python3 -c 'import sys, xml.etree.ElementTree as tree;"
               "tree.parse(sys.argv[1])'" +
               quoted(sidecar(file))));
}

}  // namespace
}  // namespace gnomon::readers_test
