#include "gmsh/reader.hpp"

#include <gmsh.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <utility>

#include "gmsh/model_mesh.hpp"
#include "gmsh/script.hpp"
#include "mesh/mesh_stream.hpp"

namespace gnomon::gmsh_reader {

namespace {

void put(const void* bytes, std::size_t count) {
  const auto* place = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t now = write(mesh_stream::descriptor, place, count);
    if (now < 0 && errno == EINTR) continue;
    if (now <= 0) _exit(3);
    place += now;
    count -= static_cast<std::size_t>(now);
  }
}

void limit(int resource, double most) {
  rlimit limits{};
  getrlimit(static_cast<__rlimit_resource_t>(resource), &limits);
  limits.rlim_cur = std::min(limits.rlim_max, static_cast<rlim_t>(most));
  setrlimit(static_cast<__rlimit_resource_t>(resource), &limits);
}

/// Counts in a damaged file may ask for any memory, and for as much time.
void limit_resources(const std::string& file) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would take the mesh
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_AS, static_cast<double>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE));
  struct stat facts {};
  constexpr double seconds_at_least = 5, bytes_per_second = 1e6;  // measured: 2e7 and more
  if (file.ends_with(".msh") && stat(file.c_str(), &facts) == 0)
    limit(RLIMIT_CPU, seconds_at_least + static_cast<double>(facts.st_size) / bytes_per_second);
}

/// Nothing of the user's settings, no terminal, one thread: the same mesh every time.
void start_gmsh() {
  gmsh::initialize(0, nullptr, false);
  for (const char* name : {"General.NumThreads", "Mesh.MaxNumThreads1D", "Mesh.MaxNumThreads2D",
                           "Mesh.MaxNumThreads3D"})
    gmsh::option::setNumber(name, 1);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::logger::start();
}

std::string first_error() {
  std::vector<std::string> lines;
  gmsh::logger::get(lines);
  for (const std::string& line : lines)
    if (line.starts_with("Error: ")) return line.substr(7);
  return {};
}

/// One line of letters that every terminal can show.
std::string tidy(std::string text) {
  for (char& letter : text)
    if (static_cast<unsigned char>(letter) < ' ' || letter == 127) letter = ' ';
  constexpr std::size_t most = 300;
  if (text.size() > most) text = text.substr(0, most) + " ...";
  return text;
}

void open(const std::string& file) {
  try {
    gmsh::open(file);
  } catch (const std::bad_alloc&) {
    throw std::runtime_error("it asks for more memory than there is");
  } catch (...) {  // Gmsh throws texts and numbers; what it says stands in its log
    const std::string error = first_error();
    throw std::runtime_error(error.empty() ? "Gmsh cannot read it" : error);
  }
  if (const std::string error = first_error(); !error.empty()) throw std::runtime_error(error);
}

/// Whether the factor that the script was opened with changes the number of elements of some curve.
bool changes_curves(const std::string& script) {
  const double with = elements_on_curves();
  ask_for_factor(1);
  open(script);
  return with != elements_on_curves();
}

ImportedMesh read(const std::string& file, double size, double factor, const std::string& zone,
                  bool geometry) {
  if (geometry) ask_for_factor(factor);
  open(file);
  ImportedMesh mesh;
  if (!zone.empty()) ask_for_zone(zone);
  if (geometry) mesh_geometry(size, factor, file.ends_with(".geo"), mesh.remarks);
  if (const std::string error = first_error(); !error.empty()) throw std::runtime_error(error);
  mesh.has_sizes = !geometry;
  if (file.ends_with(".geo")) {
    const Script script(file);
    mesh.has_sizes = script.gives_sizes();
    for (std::string& sentence : script.absent_members()) mesh.remarks.push_back(tidy(sentence));
  }
  copy_model(mesh, geometry);
  constexpr double rounding = 1e-9;  // of factors that a plan has multiplied
  const bool is_scaled = std::abs(factor - 1) > rounding;
  const auto say_idle = [&](const std::string& what) {
    mesh.remarks.push_back(what +
                           " changes the number of elements on no curve: the script gives these "
                           "numbers (Transfinite)");
  };
  if (file.ends_with(".geo") && size > 0 && !curves_follow_sizes()) say_idle("its size");
  if (file.ends_with(".geo") && mesh.has_sizes && is_scaled && !changes_curves(file))
    say_idle("its factor");
  return mesh;
}

/// Gmsh's words, and what they mean where they do not say so.
std::string explained(const std::string& error) {
  constexpr std::pair<const char*, const char*> meanings[] = {
      {"closed", "expected curves of a loop that end where the next begins"},
      {"Loop", "expected curves that follow each other, -2 for curve 2 backwards"},
      {"recover the edge", "an outline may cross itself there"},
      {"Wrong mesh element size", "expected positive sizes"}};
  for (const auto& [words, meaning] : meanings)
    if (error.find(words) != std::string::npos) return "Gmsh complains: " + error + ": " + meaning;
  return "Gmsh complains: " + error;
}

void hand_over(char letter, auto content) {
  mesh_stream::Stream<false, decltype(&put)> writer{&put};
  writer(letter);
  writer(content);
}

/// What Gmsh throws among its threads, the text of its error, cannot be caught there.
[[noreturn]] void end_with_complaint() {
  try {
    std::rethrow_exception(std::current_exception());
  } catch (const std::string& error) {
    hand_over(mesh_stream::complaint, tidy(explained(error)));
    _exit(0);
  } catch (...) {
    std::abort();
  }
}

}  // namespace

int hand_over_mesh(const std::string& file, double size, double factor, const std::string& zone) {
  limit_resources(file);
  std::set_terminate(end_with_complaint);
  std::string complaint;
  try {
    start_gmsh();
    hand_over(mesh_stream::sound, read(file, size, factor, zone, !file.ends_with(".msh")));
    return 0;
  } catch (const Refusal& refusal) {
    complaint = refusal.what();
  } catch (const std::exception& error) {
    complaint = explained(error.what());
  } catch (...) {
    const std::string error = first_error();
    complaint = explained(error.empty() ? "it failed" : error);
  }
  hand_over(mesh_stream::complaint, tidy(complaint));
  return 0;
}

}  // namespace gnomon::gmsh_reader
