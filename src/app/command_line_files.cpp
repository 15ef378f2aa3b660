// The commands that show what a result or a mesh holds, and lists of what gnomon has.

#include <fmt/ranges.h>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/options.hpp"

namespace gnomon::app {

void CommandLine::add_inspection() {
  const std::string subjects = fmt::format("{}", fmt::join(list_subjects(), ", "));
  CLI::App* list = app_.add_subcommand("list", "Lists one of " + subjects);
  list->add_option("SUBJECT", subject_, subjects + "; default: these names")->type_name("");
  on(list, [this] { list_command(subject_); });

  const auto add = [this](const char* name, const char* help,
                          void (*show)(const std::filesystem::path&)) {
    CLI::App* command = app_.add_subcommand(name, help);
    add_argument(command, "RESULT", result_, "Result file (HDF5)");
    on(command, [this, show] { show(result_); });
  };
  add("info", "Shows the contents of a result file", info_command);
  CLI::App* contact = app_.add_subcommand("contact", "Prints the contact surface as CSV");
  add_argument(contact, "RESULT", result_, "Result file (HDF5)");
  contact
      ->add_option("--time", time_,
                   "A stored time, as it was printed or stands in a figure (350, \"350 s\"); "
                   "default: the last one")
      ->type_name("T")
      ->check(check_time);
  on(contact, [this] { contact_command(result_, time_); });
  add("scene", "Prints the scene of a result", scene_command);
  add("history", "Prints what was observed after every step as CSV", history_command);
}

void CommandLine::add_meshes() {
  CLI::App* mesh = app_.add_subcommand(
      "mesh", "Reads or makes a mesh (.msh, .geo, .step, .h5) and describes it");
  CLI::App* part =
      app_.add_subcommand("new", "Writes a commented scene for a mesh or geometry of one's own");
  for (CLI::App* command : {mesh, part}) {
    add_argument(command, "FILE", result_,
                 command == mesh
                     ? "Mesh (.msh), geometry (.geo, .step), or result (.h5) whose mesh "
                       "came from a file"
                     : "Mesh (.msh) or geometry (.geo, .step)");
    add_number(command, "--size", size_, "LENGTH",
               "Longest edge where the geometry asks for no smaller one");
  }
  add_name(part, "-o,--output", scene_, "SCENE.toml", "Scene file; default: FILE's name and .toml");
  add_name(
      mesh, "-o,--output", scene_, "FILE.png|.svg|.xdmf|.msh",
      "Also draws the mesh with its named parts (a picture, or a file for ParaView), or writes "
      "the mesh that a run would use, for Gmsh (.msh)");
  on(mesh, [this] { mesh_command(result_, size_, scene_); });
  on(part, [this] { new_command(result_, size_, scene_); });
}

}  // namespace gnomon::app
