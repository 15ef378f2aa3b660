# The public surface of the library (docs/library.md). Headers that these include are installed with them, but only
# what is declared here is meant for use.
set(gnomon_public_headers
  gnomon/base/error.hpp              # exceptions
  gnomon/base/counters.hpp           # work of a run
  gnomon/base/installation.hpp       # files of the installation
  gnomon/base/version.hpp
  gnomon/scene/scene.hpp             # scenes and their keys
  gnomon/scene/keys.hpp              # their commonest kinds
  gnomon/scene/registry.hpp          # registrations
  gnomon/laws/wear_law.hpp           # wear laws
  gnomon/shapes/counter_shape.hpp      # shapes of counter-bodies
  gnomon/wear_laws/wear_law_kind.hpp # both by name
  gnomon/shapes/counter_shape_kind.hpp
  gnomon/shapes/shape_keys.hpp       # keys that shapes share
  gnomon/terms/material_law.hpp      # materials
  gnomon/terms/solid_kernels.hpp     # and what one is made of
  gnomon/terms/body_term.hpp         # terms of a physics
  gnomon/terms/shape_evolution.hpp
  gnomon/terms/mesh_motion.hpp
  gnomon/system/linear_solver.hpp    # linear solvers
  gnomon/newton/linear_solver_kind.hpp
  gnomon/model/problem.hpp           # problems
  gnomon/model/model.hpp             # and what they make of a scene
  gnomon/model/observation.hpp
  gnomon/model/assembly.hpp          # wearing bodies as data
  gnomon/model/magnitudes.hpp
  gnomon/model/wear_model.hpp        # and their model
  gnomon/model/physics.hpp           # models of other physics on a mesh
  gnomon/part/part_scene.hpp         # what a scene says of them
  gnomon/part/assembly_scene.hpp
  gnomon/cycles/cycle_scene.hpp      # and of cycles
  gnomon/cycles/compared_rates.hpp   # by two sets of phases
  gnomon/system/system.hpp           # residual, Jacobian, switching functions
  gnomon/system/state.hpp
  gnomon/system/composed_system.hpp  # a system made of terms
  gnomon/integrators/integrator.hpp  # integrators
  gnomon/integrators/one_step.hpp    # one-step methods
  gnomon/integrators/stepper.hpp     # and what drives them
  gnomon/integrators/stop_times.hpp  # where steps end
  gnomon/integrators/diagonally_implicit.hpp
  gnomon/integrators/rates.hpp       # rates of a consistent state
  gnomon/newton/algebraic_solver.hpp # algebraic components of a state
  gnomon/run/setup.hpp               # from a scene to a model
  gnomon/run/run.hpp                 # runs
  gnomon/run/summary.hpp
  gnomon/run/plugin.hpp              # plug-ins
  gnomon/results/result_files.hpp    # results
  gnomon/results/results.hpp
  gnomon/results/versions.hpp)

# All headers that headers in `found` include, directly or through others.
function(gnomon_headers_included_by result)
  set(found "")
  set(next ${ARGN})
  while(next)
    list(POP_FRONT next header)
    if(header IN_LIST found)
      continue()
    endif()
    list(APPEND found ${header})
    file(STRINGS ${PROJECT_SOURCE_DIR}/include/${header} lines REGEX "^#include <gnomon/")
    foreach(line ${lines})
      string(REGEX REPLACE "^#include <(.*)>.*" "\\1" included "${line}")
      list(APPEND next ${included})
    endforeach()
  endwhile()
  list(REMOVE_ITEM found ${ARGN})
  set(${result} ${found} PARENT_SCOPE)
endfunction()
gnomon_headers_included_by(gnomon_included_headers ${gnomon_public_headers})

# A stamp of the interface: the same for the same headers.
set(contents "")
foreach(header ${gnomon_public_headers} ${gnomon_included_headers})
  set(file ${PROJECT_SOURCE_DIR}/include/${header})
  set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(SHA256 ${file} content)
  string(APPEND contents ${content})
endforeach()
string(SHA256 gnomon_interface_stamp "${contents}")
