// The commands that show what a result or a mesh holds, and lists of what gnomon has.

#include "app/command_line.hpp"
#include "app/option_checks.hpp"
#include "app/stored_time.hpp"

namespace gnomon::app {

void CommandLine::add_inspection() {
  CLI::App* list = app_.add_subcommand(
      "list",
      "Lists integrators, wear laws, materials, shapes, terms, problems, scenes or studies");
  list->add_option("SUBJECT", subject_,
                   "integrators, laws, materials, shapes, terms, problems, scenes or studies; "
                   "default: these names")
      ->type_name("");
  list->callback([this] { command_ = [this] { return list_command(subject_); }; });

  CLI::App* info = app_.add_subcommand("info", "Shows the contents of a result file");
  info->add_option("RESULT", result_, "Result file (HDF5)")->required()->type_name("");
  info->callback([this] { command_ = [this] { return info_command(result_); }; });

  CLI::App* contact = app_.add_subcommand("contact", "Prints the contact surface as CSV");
  contact->add_option("RESULT", result_, "Result file (HDF5)")->required()->type_name("");
  contact
      ->add_option(
          "--time", time_,
          "A stored time, as it was printed or stands in a figure (350, \"350 s\"); default: "
          "the last one")
      ->type_name("T")
      ->check(check_time);
  contact->callback([this] { command_ = [this] { return contact_command(result_, time_); }; });

  CLI::App* scene = app_.add_subcommand("scene", "Prints the scene of a result");
  scene->add_option("RESULT", result_, "Result file (HDF5)")->required()->type_name("");
  scene->callback([this] { command_ = [this] { return scene_command(result_); }; });

  CLI::App* history =
      app_.add_subcommand("history", "Prints what was observed after every step as CSV");
  history->add_option("RESULT", result_, "Result file (HDF5)")->required()->type_name("");
  history->callback([this] { command_ = [this] { return history_command(result_); }; });
}

void CommandLine::add_meshes() {
  CLI::App* mesh = app_.add_subcommand(
      "mesh", "Reads or makes a mesh (.msh, .geo, .step, .h5) and describes it");
  CLI::App* part =
      app_.add_subcommand("new", "Writes a commented scene for a mesh or geometry of one's own");
  for (CLI::App* command : {mesh, part}) {
    command
        ->add_option("FILE", result_,
                     command == mesh ? "Mesh (.msh), geometry (.geo, .step), or result (.h5) whose "
                                       "mesh came from a file"
                                     : "Mesh (.msh) or geometry (.geo, .step)")
        ->required()
        ->type_name("");
    command->add_option("--size", size_, "Longest edge where the geometry asks for no smaller one")
        ->type_name("LENGTH")
        ->check(check_number);
  }
  part->add_option("-o,--output", scene_, "Scene file; default: FILE's name and .toml")
      ->type_name("SCENE.toml")
      ->check(check_file_name);
  mesh->add_option(
          "-o,--output", scene_,
          "Also draws the mesh with its named parts (a picture, or a file for ParaView), or "
          "writes the mesh that a run would use, for Gmsh (.msh)")
      ->type_name("FILE.png|.svg|.xdmf|.msh")
      ->check(check_file_name);
  mesh->callback([this] { command_ = [this] { return mesh_command(result_, size_, scene_); }; });
  part->callback([this] { command_ = [this] { return new_command(result_, size_, scene_); }; });
}

}  // namespace gnomon::app
