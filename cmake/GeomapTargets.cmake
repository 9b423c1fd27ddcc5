# SPDX-License-Identifier: BSD-3-Clause
# How every target of this project is built: language, warnings, sanitizers, version, tests.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

add_library(geomap_flags INTERFACE)
# The same source must give the same bytes on every machine: no contraction into fused multiply-adds.
target_compile_options(geomap_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion -Werror
                                              -ffp-contract=off)
if(CMAKE_UNITY_BUILD)
  # It takes what a .cpp file has in its anonymous namespace for a header's.
  target_compile_options(geomap_flags INTERFACE -Wno-subobject-linkage)
endif()
if(GEOMAP_SANITIZE)
  add_compile_options(-O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # g++ 12 sees uninitialised memory in the standard library's own templates when it instruments them.
  target_compile_options(geomap_flags INTERFACE -Wno-maybe-uninitialized)
endif()

# geomap_library(NAME SOURCES ... [PUBLIC ...] [PRIVATE ...]): one static library of one folder.
function(geomap_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE geomap_flags ${ARG_PRIVATE})
endfunction()

# What a user runs, without tests and benchmarks.
add_custom_target(geomap_programs)

# geomap_program(NAME SOURCES ... LINK ...): one executable in build/bin.
function(geomap_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE geomap_flags ${ARG_LINK})
  if(name MATCHES "^geomap-")
    add_dependencies(geomap_programs ${name})
  endif()
endfunction()
