// The memory of a run is estimated beforehand, and a run that would need more than is available is
// refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/model/problem.hpp>

#include "app/child.hpp"

namespace gnomon::memory_test {
namespace {

using test::Outcome;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

const std::string problems = std::string(GNOMON_SOURCE_DIR) + "/problems/";

class Memory : public test::ProgramTest {
protected:
  /// Peak memory of a step of the scene [bytes], as the system counts it, without a budget, which
  /// has another model of so small a run.
  double peak(const std::string& scene, const std::vector<std::string>& overrides) const {
    std::vector<std::string> arguments = {
        "run",          problems + scene,     "--quiet", "--force",
        "--set",        "output.times=[]",    "--set",   "time.end=1",
        "--integrator", "backward-euler",     "--set",   "integrator.step=1",
        "--set",        "output.budget=false"};
    for (const std::string& text : overrides) arguments.insert(arguments.end(), {"--set", text});
    const pid_t child = start(arguments);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << scene;
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
  }
};

/// Before the mesh exists.
double by_keys(const std::string& scene, const std::vector<std::string>& overrides) {
  return estimated_memory(load_scene(problems + scene, overrides, key_table));
}

double by_mesh(const std::string& scene, const std::vector<std::string>& overrides) {
  return make_model(load_scene(problems + scene, overrides, key_table))->memory;
}

// 15 % where it was measured (docs/notes/linear.md); other machines have other libraries.
TEST_F(Memory, IsEstimatedWithinAQuarterInSpace) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer takes much more";
#endif
  std::vector<std::string> ball = {"mesh.elements=[11,4,5]"};
  std::vector<std::string> flat_block = {"mesh.elements=[20,40,4]", "mesh.size=[0.06,0.04,0.2]",
                                         "mesh.fine=[0,0,0]"};
  for (const std::string preconditioner : {"factor", "multigrid"}) {
    if (preconditioner == "multigrid" && !has_multigrid()) continue;
    for (const auto& [scene, mesh] :
         {std::pair("ball_on_flat/small_deformation.toml", ball),
          std::pair("ball_on_half_space/small_deformation.toml", flat_block)}) {
      std::vector<std::string> overrides = mesh;
      overrides.push_back("solver.preconditioner=" + preconditioner);
      const double told = by_mesh(scene, overrides), taken = peak(scene, overrides);
      EXPECT_NEAR(told / taken, 1, 0.25) << scene << ' ' << preconditioner;
    }
  }
}

TEST_F(Memory, IsEstimatedByTheKeysWithinAFactorOfTwo) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer takes much more";
#endif
  const std::pair<const char*, std::vector<std::string>> scenes[] = {
      {"pin_on_flat/small_deformation.toml", {}},
      {"pin_on_flat/finite_deformation.toml", {"solver.method=block"}},
      {"flat_punch/small_block.toml", {}},
      {"ball_on_flat/small_deformation.toml", {"mesh.elements=[8,3,4]"}},
      {"ball_on_flat/small_deformation.toml", {"mesh.elements=[5,2,3]", "solver.method=direct"}},
      {"ball_on_half_space/small_deformation.toml",
       {"mesh.elements=[10,20,6]", "mesh.size=[0.06,0.06,0.06]", "mesh.fine=[0,0,0]"}}};
  for (const auto& [scene, overrides] : scenes) {
    const double told = by_keys(scene, overrides), taken = peak(scene, overrides);
    EXPECT_LT(told, 2 * taken) << scene;
    EXPECT_GT(told, taken / 2) << scene;
  }
}

TEST_F(Memory, TooLargeAMeshIsRefusedWithTheFigures) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer reserves terabytes";
#endif
  rlimit old{};
  getrlimit(RLIMIT_AS, &old);
  rlimit small = old;
  small.rlim_cur = 2'000'000'000;
  setrlimit(RLIMIT_AS, &small);  // the child inherits it
  for (const char* command : {"run", "check", "stability"}) {
    const Outcome outcome = gnomon({command, test::pin, "--set", "mesh.elements=[1000,1000]"});
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_THAT(outcome.err,
                ContainsRegex("needs about 12 GB of memory with "
                              "solver[.]preconditioner = \"factor\", 1[.][0-9]+ GB are"));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  // Too little for the libraries and the buffer of OpenBLAS, which would wait for it for ever.
  small.rlim_cur = 200'000'000;
  setrlimit(RLIMIT_AS, &small);
  const Outcome outcome = gnomon({"run", test::pin});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_THAT(outcome.err,
              ContainsRegex("needs about 45 MB of memory with .*, [0-9]+ MB are available"));
  setrlimit(RLIMIT_AS, &old);
  EXPECT_TRUE(files().empty());
}

// A body of 100,000 nodes in space.
TEST(MissingMemory, IsToldWithTheSolverAndAThriftierOne) {
  const MeshSize mesh{.dim = 3, .nodes = 1e5, .displacements = 3e5};
  const auto scene = [](const char* method, const char* preconditioner) {
    return load_scene(problems + "ball_on_half_space/small_deformation.toml",
                      {std::string("solver.method=") + method,
                       std::string("solver.preconditioner=") + preconditioner},
                      key_table);
  };
  const Scene direct = scene("direct", "factor"), factor = scene("block", "factor"),
              multigrid = scene("block", "multigrid");
  const double by_direct = estimated_memory(direct, mesh),
               by_factor = estimated_memory(factor, mesh),
               by_multigrid = estimated_memory(multigrid, mesh);
  ASSERT_LT(by_factor, 0.5 * by_direct);
  const auto text = [&](const Scene& solver, double available) {
    return missing_memory_text(solver, mesh, estimated_memory(solver, mesh), available);
  };
  EXPECT_EQ(text(direct, by_direct), "");
  const std::string needed =
      "about " + memory_text(by_factor) + " of memory with solver.preconditioner = \"factor\", ";
  const std::string thrifty =
      ", or solver.preconditioner = \"multigrid\", which needs about " + memory_text(by_multigrid);
  if (has_multigrid()) {
    ASSERT_LT(by_multigrid, 0.5 * by_factor);
    EXPECT_EQ(text(factor, by_multigrid), needed + memory_text(by_multigrid) +
                                              " are available; expected a coarser mesh" + thrifty);
  }
  EXPECT_EQ(text(factor, 1e6), needed + "1 MB are available; expected a coarser mesh");
  EXPECT_THAT(text(direct, by_factor),
              HasSubstr("with solver.method = \"direct\", " + memory_text(by_factor) +
                        " are available; expected a coarser mesh, or solver.method = \"block\", "
                        "which needs about " +
                        memory_text(by_factor)));
  if (has_multigrid()) {
    EXPECT_THAT(text(direct, by_multigrid),
                HasSubstr("mesh, or solver.method = \"block\" with solver.preconditioner = "
                          "\"multigrid\", which needs about " +
                          memory_text(by_multigrid)));
  }
  EXPECT_THAT(text(multigrid, 1e6), testing::EndsWith("expected a coarser mesh"));
}

TEST_F(Memory, IsToldByCheck) {
  EXPECT_THAT(gnomon({"check", test::pin}).out, HasSubstr("# a run takes about 45 MB of memory"));
  EXPECT_EQ(gnomon({"check", problems + "dahlquist/decay.toml"}).out.find("memory"),
            std::string::npos);
}

}  // namespace
}  // namespace gnomon::memory_test
