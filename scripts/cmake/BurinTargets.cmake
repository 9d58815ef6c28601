# burin_library(NAME SOURCES ... [PUBLIC ...] [PRIVATE ...]): static library burin_NAME with alias
# burin::NAME (the name it has when installed, too), the folder's include/ directory and the
# project's warnings.
add_library(burin_warnings INTERFACE)
target_compile_options(burin_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wnon-virtual-dtor
  -Wold-style-cast $<$<BOOL:${BURIN_WARNINGS_AS_ERRORS}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # Warns of "text" + std::string when optimising (GCC bug 105651, mended in 13).
  target_compile_options(burin_warnings INTERFACE -Wno-restrict)
endif()
option(BURIN_UNITY "Compile several files at once" OFF)
if(BURIN_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Takes the files of a unity build for headers, of which each program would get its own namespace.
  target_compile_options(burin_warnings INTERFACE -Wno-subobject-linkage)
  # The compiler collects its garbage from 128 MB on, again and again: a tenth of the time of what reads
  # scenes. A gigabyte is more than all but a few files need.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=1000000>)
endif()
if(BURIN_SANITIZE)
  add_compile_options(-fsanitize=${BURIN_SANITIZE} -fno-omit-frame-pointer
                      -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${BURIN_SANITIZE})
endif()

# Headers that nearly every file includes, compiled once for the libraries and once for the tests:
# half of what a small file takes. Files still include what they use; preset dev builds without.
option(BURIN_PRECOMPILE_HEADERS "Compile common headers, and what reads scenes, once" ON)
set(BURIN_COMMON_HEADERS
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <memory> <optional> <span> <string>
  <string_view> <variant> <vector> <fmt/format.h> <glm/glm.hpp>)
if(BURIN_PRECOMPILE_HEADERS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)  # ccache needs it
endif()

# burin_headers(OWNER HEADERS …): OWNER compiles those headers for others.
function(burin_headers owner)
  if(BURIN_PRECOMPILE_HEADERS)
    target_precompile_headers(${owner} PRIVATE ${ARGN})
  endif()
endfunction()

# burin_use_headers(TARGET OWNER): TARGET uses them; it must be compiled with the same options.
function(burin_use_headers target owner)
  if(BURIN_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# burin_unity(TARGET …): compiles several of their files at once where BURIN_UNITY is on (preset
# asan-ubsan; preset release in CI): much of what a small file takes is headers and templates that its
# neighbours have, too.
function(burin_unity)
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ${BURIN_UNITY} UNITY_BUILD_BATCH_SIZE 9)
endfunction()

add_library(burin_headers STATIC ${CMAKE_CURRENT_LIST_DIR}/headers.cpp)
target_compile_features(burin_headers PUBLIC cxx_std_20)
target_link_libraries(burin_headers PRIVATE fmt::fmt glm::glm burin_warnings)
burin_headers(burin_headers ${BURIN_COMMON_HEADERS})

function(burin_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(burin_${name} STATIC ${arg_SOURCES})
  add_library(burin::${name} ALIAS burin_${name})
  set_target_properties(burin_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(burin_${name} PUBLIC cxx_std_20)
  target_include_directories(burin_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(burin_${name} PUBLIC ${arg_PUBLIC}
    PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:burin_warnings>)
  burin_use_headers(burin_${name} burin_headers)
endfunction()

# Options for code that runs a few times in a program's life and is mostly templates of others (JSON,
# CLI11, fmt). Optimised less, and with the address sanitizer's checks as calls instead of inline, it
# compiles in two thirds of the time.
set(BURIN_COLD_OPTIONS $<$<CONFIG:Release>:-O1>)
set(BURIN_CHECKS_AS_CALLS "")
if(BURIN_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(BURIN_CHECKS_AS_CALLS --param=asan-instrumentation-with-call-threshold=0)
  list(APPEND BURIN_COLD_OPTIONS ${BURIN_CHECKS_AS_CALLS})
endif()

# burin_cold_sources(SOURCE …): compiles these files of a library so, each by itself (CMake takes files with
# options of their own out of unity builds).
function(burin_cold_sources)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${BURIN_COLD_OPTIONS}")
endfunction()

# burin_cold_objects(NAME SOURCES … LIBRARIES …): compiles these files so, together in unity builds. A
# library takes them up with $<TARGET_OBJECTS:burin_NAME>.
function(burin_cold_objects name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(burin_${name} OBJECT ${arg_SOURCES})
  target_include_directories(burin_${name} PRIVATE include src)
  target_compile_options(burin_${name} PRIVATE ${BURIN_COLD_OPTIONS})
  target_link_libraries(burin_${name} PRIVATE ${arg_LIBRARIES} burin_warnings)
  burin_use_headers(burin_${name} burin_headers)
  burin_unity(burin_${name})
endfunction()
