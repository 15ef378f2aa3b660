// Runs the real program in its own folder and captures its output.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace gnomon::test {

struct Outcome {
  int exit_code = -1;  ///< -signal when it was killed
  std::string out;
  std::string err;
};

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Whether figures and pages can be drawn here.
inline bool can_draw() {
  return std::system("/usr/bin/python3 -c 'import matplotlib, h5py, jinja2' 2>/dev/null") == 0;
}
inline constexpr const char* drawing_needs =
    "needs python3-matplotlib, python3-h5py and python3-jinja2";

/// A test with an empty folder in which the program runs; its output is stored beside the folder.
class ProgramTest : public testing::Test {
protected:
  ProgramTest() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(info->test_suite_name()) + "-" + info->name();
    for (char& c : name)
      if (c == '/') c = '-';
    root_ = std::filesystem::temp_directory_path() /
            ("gnomon-" + name + "-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder());
  }
  ~ProgramTest() override { std::filesystem::remove_all(root_); }

  std::filesystem::path folder() const { return root_ / "folder"; }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder() / name) << text;
  }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  pid_t start(const std::vector<std::string>& arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    std::vector<char*> argv = {const_cast<char*>("gnomon")};
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    redirect(root_ / "out", STDOUT_FILENO);
    redirect(root_ / "err", STDERR_FILENO);
    if (chdir(folder().c_str()) == 0) execv(GNOMON_PROGRAM, argv.data());
    _exit(127);
  }

  Outcome finish(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return {code, read_text(root_ / "out"), read_text(root_ / "err")};
  }

  Outcome gnomon(const std::vector<std::string>& arguments) const {
    return finish(start(arguments));
  }

  /// Waits until a child catches this signal: by the mask of its status, because how long a program
  /// takes to begin depends on the machine. False if it ends before.
  static bool catches(pid_t child, int signal) {
    const std::string status = "/proc/" + std::to_string(child) + "/status", key = "SigCgt:";
    const auto runs = [&] {
      siginfo_t end{};
      return waitid(P_PID, static_cast<id_t>(child), &end, WEXITED | WNOHANG | WNOWAIT) == 0 &&
             end.si_pid == 0;
    };
    for (; runs(); usleep(1000)) {
      const std::string text = read_text(status);
      const std::size_t at = text.find(key);
      if (at != std::string::npos &&
          (std::stoull(text.substr(at + key.size()), nullptr, 16) >> (signal - 1) & 1) != 0)
        return true;
    }
    return false;
  }

private:
  static void redirect(const std::filesystem::path& file, int descriptor) {
    const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(opened, descriptor);
    close(opened);
  }

  std::filesystem::path root_;
};

/// The shipped pin, so coarse that it runs very fast.
inline const std::string pin =
    std::string(GNOMON_SOURCE_DIR) + "/problems/pin_on_flat/small_deformation.toml";
inline const std::string coarse = "mesh.elements=[8,8]";

}  // namespace gnomon::test
