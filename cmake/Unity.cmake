# Several source files of a folder are one translation unit, because the headers of other libraries take most of the
# compiler's time; about 60 kB a unit, so that cores share the work and a change compiles little. Names in unnamed
# namespaces are therefore those of the folder. What a file includes it still names itself: scripts/matrix has a
# build without this (GNOMON_UNITY=OFF) and without precompiled headers.

# Files that take as long as others together, and instantiations of classes whose other members other files define: in
# one unit Clang wants these first.
set(gnomon_alone "/(terms/solid|terms/mortar_term|model/worn_body_equations)\\.cpp$")

function(gnomon_unity target)
  if(NOT GNOMON_UNITY)
    return()
  endif()
  foreach(source ${ARGN})
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME room)
    file(SIZE ${source} size)
    math(EXPR ${room}_size "${${room}_size} + ${size}")
    math(EXPR part "${${room}_size} / 60000")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${part})
    if("/${source}" MATCHES "${gnomon_alone}")
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC takes every included file for a header, in which a member of an unnamed type would be a mistake.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()
