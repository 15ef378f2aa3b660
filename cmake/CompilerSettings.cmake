# Warnings and instrumentation that every target of the project shares.
add_library(gnomon_settings INTERFACE)
target_compile_options(gnomon_settings INTERFACE -Wall -Wextra -Wpedantic $<$<BOOL:${GNOMON_WERROR}>:-Werror>)
# GCC 13 and 14 take any reference that a function returns for one to its arguments, even where it refers to a member.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  target_compile_options(gnomon_settings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-dangling-reference>)
endif()
# __FILE__ is relative, so that no binary names the folder where it was built.
target_compile_options(gnomon_settings INTERFACE -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
set(gnomon_sanitizers -fsanitize=address,undefined -fno-sanitize-recover=undefined
                      $<$<CXX_COMPILER_ID:Clang>:-D__SANITIZE_ADDRESS__>)  # as GCC
if(GNOMON_SANITIZE)
  target_compile_options(gnomon_settings INTERFACE ${gnomon_sanitizers} -fno-omit-frame-pointer)
  target_link_options(gnomon_settings INTERFACE -fsanitize=address,undefined)
endif()
if(GNOMON_COVERAGE)
  # Eigen's functions are not of interest, and counting in them would take most of the time.
  target_compile_options(gnomon_settings INTERFACE --coverage -fprofile-exclude-files=^/usr/.*)
  target_link_options(gnomon_settings INTERFACE --coverage)
endif()
if(GNOMON_FUZZ)
  target_compile_options(gnomon_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(GNOMON_NATIVE)
  target_compile_options(gnomon_settings INTERFACE -march=native)
endif()

# Headers of other libraries that most units include: they are compiled once for the library, once for the tests.
set(gnomon_common_headers <Eigen/Dense> <fmt/format.h> <algorithm> <cmath> <filesystem> <functional> <map> <memory>
    <optional> <span> <string> <vector>)
