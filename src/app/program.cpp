#include "app/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <gnomon/base/mistakes.hpp>
#include <new>

#include "app/command_line.hpp"

namespace gnomon::app {

namespace {

/// Prints one line for every message, whatever it contains (names of files may contain any
/// character).
void complain(const std::string& message) {
  std::string line = message;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  std::fputs(("gnomon: " + line + "\n").c_str(), stderr);  // unlike fmt::print, never throws
}

/// The next file that is opened, perhaps the result, would get the number of a closed stream, and
/// all printed text would be written into that file. Here that number is given to a file that
/// cannot be written.
void occupy_closed_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) < 0 && open("/dev/null", O_RDONLY) != descriptor) return;
}

int guarded(CommandLine& command_line, int argc, char** argv) {
  try {
    return command_line(argc, argv);
  } catch (const CLI::ParseError& error) {
    complain(command_line.complaint(error));
    return bad_input;
  } catch (const InputErrors& errors) {
    for (const std::string& line : errors.lines) complain(line);
    return bad_input;
  } catch (const InputError& error) {
    complain(error.what());
    return bad_input;
  } catch (const SolutionError& error) {
    complain(error.what());
    return solution_failed;
  } catch (const std::filesystem::filesystem_error& error) {  // a name too long, links in a circle
    complain(fmt::format("{}: {}", error.path1().string(), error.code().message()));
    return bad_input;
  } catch (const std::bad_alloc&) {
    complain("out of memory");
    return other_failure;
  } catch (const std::exception& error) {
    complain(error.what());
    return other_failure;
  } catch (...) {
    complain("a plug-in threw something that is no std::exception");
    return other_failure;
  }
}

}  // namespace

int program(int argc, char** argv) {
  occupy_closed_streams();
  CommandLine command_line;
  const int code = guarded(command_line, argc, argv);
  // If stdout is redirected to a full disk, the error appears only here.
  if (std::fflush(stdout) != 0 && code == success) {
    complain("cannot write to standard output");
    return other_failure;
  }
  return code;
}

}  // namespace gnomon::app
